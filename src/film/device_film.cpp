#include "film/device_film.h"

#include "device/buffer_state.h"
#include "film/moments.h"

#include <algorithm>

namespace sundog {

namespace {

// As TILE_SIZE in kernels/scene/camera_rays.h; a test compares the two orders.
constexpr std::size_t tile_size = 8;

const std::vector<std::string> channel_names = {"R",        "G",        "B",   "variance.R", "variance.G", "variance.B", "albedo.R",
                                                "albedo.G", "albedo.B", "N.X", "N.Y",        "N.Z",        "depth.Z"};

} // namespace

DeviceFilm::DeviceFilm(Device& device, int width, int height)
    : width_(width), height_(height), accumulate_film_(device, "accumulate_film", "Accumulate film"), invalid_samples_(device, 1, "invalid samples")
{
    first_hits = Buffer<FirstHitPixel>(device, std::vector<FirstHitPixel>(pixel_count()), "first hit channels");
    pixels_ = Buffer<FilmPixel>(device, std::vector<FilmPixel>(pixel_count()), "film");
    invalid_samples_.fill(0);
}

void DeviceFilm::accumulate(const Buffer<Vec3>& radiance)
{
    accumulate_film_(pixel_count(), radiance, static_cast<uint>(pixel_count()), pixels_, invalid_samples_);
    if (errors) errors->accumulate(radiance);
    iterations_++;
}

std::uint64_t DeviceFilm::invalid_samples() const
{
    return invalid_samples_.read(0);
}

void DeviceFilm::serialize(StateArchive& archive)
{
    archive.value("film iterations", iterations_);
    sundog::serialize(archive, "film", pixels_);
    sundog::serialize(archive, "first hit channels", first_hits);
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

Image DeviceFilm::resolve() const
{
    const std::vector<FilmPixel> pixels = pixels_.download();
    std::vector<std::string> names = channel_names;
    std::vector<float> error_channels;
    if (errors) {
        const std::vector<std::string> more = errors->channel_names();
        names.insert(names.end(), more.begin(), more.end());
        error_channels = errors->channels(pixels, iterations_);
    }
    const std::size_t more = names.size() - channel_names.size();
    Image image(width_, height_, names);
    const std::vector<FirstHitPixel> hits = first_hits.download();
    const double n = static_cast<double>(std::max<std::uint64_t>(iterations_, 1));
    for (std::size_t path = 0; path < pixels.size(); path++) {
        const FilmPixel& p = pixels[path];
        const FirstHitPixel& hit = hits[path];
        float* out = &image.pixels[pixel_of_path(path) * names.size()];
        const Moments channel[3] = {moments(p.sum.x, p.sum_error.x, p.squares.x, p.squares_error.x, n),
                                    moments(p.sum.y, p.sum_error.y, p.squares.y, p.squares_error.y, n),
                                    moments(p.sum.z, p.sum_error.z, p.squares.z, p.squares_error.z, n)};
        for (int c = 0; c < 3; c++) {
            out[c] = static_cast<float>(channel[c].mean);
            out[3 + c] = static_cast<float>(channel[c].variance);
        }
        const float rest[7] = {hit.albedo.x, hit.albedo.y, hit.albedo.z, hit.normal.x, hit.normal.y, hit.normal.z, hit.depth};
        std::copy(std::begin(rest), std::end(rest), out + 6);
        std::copy_n(error_channels.data() + path * more, more, out + channel_names.size());
    }
    return image;
}

} // namespace sundog
