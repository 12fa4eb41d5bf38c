#include "film/device_film.h"

#include "base/fault_injection.h"
#include "device/buffer_state.h"
#include "film/moments.h"
#include "math/plausible.h"

#include <algorithm>
#include <cmath>

namespace sundog {

namespace {

// As TILE_SIZE in kernels/scene/camera_rays.h; a test compares the two orders.
constexpr std::size_t tile_size = 8;

const std::vector<std::string> channel_names = {"R",        "G",        "B",   "variance.R", "variance.G", "variance.B", "albedo.R",
                                                "albedo.G", "albedo.B", "N.X", "N.Y",        "N.Z",        "depth.Z"};

bool is_first_hit(const FirstHitPixel& hit)
{
    return is_plausible(hit.albedo) && is_plausible(hit.normal) && std::abs(hit.depth) <= largest_plausible;
}

} // namespace

bool is_sum(const FilmPixel& pixel)
{
    // Squares of such radiance overflow, and no variance is known.
    constexpr float overflowing = 1e15f;
    const bool has_squares = is_plausible(pixel.squares) && is_plausible(pixel.squares_error);
    return is_plausible(pixel.sum) && is_plausible(pixel.sum_error) && (has_squares || std::max({pixel.sum.x, pixel.sum.y, pixel.sum.z}) > overflowing);
}

DeviceFilm::DeviceFilm(Device& device, int width, int height)
    : width_(width), height_(height), accumulate_film_(device, "accumulate_film", "Accumulate film"), invalid_samples_(device, 1, "invalid samples")
{
    first_hits = Buffer<FirstHitPixel>(device, std::vector<FirstHitPixel>(pixel_count()), "first hit channels");
    pixels_ = Buffer<FilmPixel>(device, std::vector<FilmPixel>(pixel_count()), "film");
    invalid_samples_.fill(0);
}

void DeviceFilm::accumulate(const Buffer<Vec3>& radiance)
{
    fault_point(FaultPoint::accumulate);
    begin_update();
    accumulate_film_(pixel_count(), radiance, static_cast<uint>(pixel_count()), pixels_, invalid_samples_);
    if (errors) errors->accumulate(radiance);
    iterations_++;
    is_whole_ = true;
}

bool DeviceFilm::begin_first_hits(std::uint64_t iteration)
{
    if (iteration < first_hit_iterations_) return false;
    first_hit_iterations_ = iteration + 1;
    return true;
}

std::uint64_t DeviceFilm::invalid_samples() const
{
    return invalid_samples_.read(0);
}

void DeviceFilm::serialize(StateArchive& archive)
{
    archive.count("film iterations", iterations_);
    if (archive.takes_blocks()) { // first hits are not taken back
        archive.count("first hit iterations", first_hit_iterations_);
        // 0: of a method that finds all of them before its first iteration.
        const bool known = first_hit_iterations_ == 0 || first_hit_iterations_ == iterations_ || first_hit_iterations_ == iterations_ + 1;
        archive.check(known, "first hit iterations");
    }
    sundog::serialize(archive, "film", pixels_, is_sum);
    sundog::serialize(archive, "first hit channels", first_hits, is_first_hit);
    sundog::serialize(archive, "invalid samples", invalid_samples_);
    if (errors) errors->serialize(archive);
}

std::size_t DeviceFilm::pixel_of_path(std::size_t path) const
{
    const std::size_t w = static_cast<std::size_t>(width_), h = static_cast<std::size_t>(height_);
    const std::size_t row = path / (tile_size * w);
    const std::size_t tile_height = std::min(tile_size, h - row * tile_size);
    const std::size_t in_row = path - row * tile_size * w;
    const std::size_t column = in_row / (tile_size * tile_height);
    const std::size_t tile_width = std::min(tile_size, w - column * tile_size);
    const std::size_t in_tile = in_row - column * tile_size * tile_height;
    return (row * tile_size + in_tile / tile_width) * w + column * tile_size + in_tile % tile_width;
}

// A band of tiles at a time: the image is all that needs room for every pixel.
Image DeviceFilm::resolve() const
{
    std::vector<std::string> names = channel_names;
    if (errors)
        for (const std::string& name : errors->channel_names()) names.push_back(name);
    Image image(width_, height_, names);
    const std::size_t band = tile_size * static_cast<std::size_t>(width_);
    for (std::size_t first = 0; first < pixel_count(); first += band) resolve_paths(first, std::min(band, pixel_count() - first), image);
    return image;
}

void DeviceFilm::resolve_paths(std::size_t first, std::size_t count, Image& image) const
{
    const std::vector<FilmPixel> pixels = pixels_.download(first, count);
    const std::vector<FirstHitPixel> hits = first_hits.download(first, count);
    const std::vector<float> error_channels = errors ? errors->channels(pixels, first, iterations_) : std::vector<float>();
    const std::size_t channels = image.channels.size(), more = channels - channel_names.size();
    const double n = static_cast<double>(std::max<std::uint64_t>(iterations_, 1));
    for (std::size_t i = 0; i < count; i++) {
        const FilmPixel& p = pixels[i];
        const FirstHitPixel& hit = hits[i];
        float* out = &image.pixels[pixel_of_path(first + i) * channels];
        const Moments channel[3] = {moments(p.sum.x, p.sum_error.x, p.squares.x, p.squares_error.x, n),
                                    moments(p.sum.y, p.sum_error.y, p.squares.y, p.squares_error.y, n),
                                    moments(p.sum.z, p.sum_error.z, p.squares.z, p.squares_error.z, n)};
        for (int c = 0; c < 3; c++) {
            out[c] = static_cast<float>(channel[c].mean);
            out[3 + c] = static_cast<float>(channel[c].variance);
        }
        const float rest[7] = {hit.albedo.x, hit.albedo.y, hit.albedo.z, hit.normal.x, hit.normal.y, hit.normal.z, hit.depth};
        std::copy(std::begin(rest), std::end(rest), out + 6);
        std::copy_n(error_channels.data() + i * more, more, out + channel_names.size());
    }
}

} // namespace sundog
