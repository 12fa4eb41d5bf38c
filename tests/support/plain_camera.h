// The camera in double precision: the order of its paths, and how it sees a point.
#pragma once

#include "support/plain_sampling.h"
#include "support/plain_surface.h"

#include <array>
#include <optional>
#include <vector>

namespace sundog
{

// Pixels (x, y) of a crop in the order of paths: in tiles of 8 x 8, cut off at the right and bottom; tiles row by row, and
// row by row in each.
inline std::vector<std::array<int, 2>> pixels_by_path(int width, int height)
{
    std::vector<std::array<int, 2>> pixels;
    for (int top = 0; top < height; top += 8)
        for (int left = 0; left < width; left += 8)
            for (int y = top; y < std::min(top + 8, height); ++y)
                for (int x = left; x < std::min(left + 8, width); ++x) pixels.push_back({x, y});
    return pixels;
}

// A point seen through a point of the lens.
struct PlainView {
    Vec3d lens;
    double depth;        // along the viewing direction
    double film[2];      // pixels of the full film
    double film_density; // pixels per solid angle at the lens, over the cosine there: importance without its cosine
};

// Nothing outside of the clip planes.
inline std::optional<PlainView> plain_view(const Camera& camera, Vec3d point, Pair u, Doubt& doubt)
{
    const Vec3d right = camera.axis_x, up = camera.axis_y, forward = camera.axis_z;
    const double aperture = camera.aperture_radius;
    Pair lens{0.0, 0.0};
    if (aperture > 0.0) lens = plain_disk(u);
    const Vec3d on_lens = Vec3d(camera.position) + (right * lens[0] + up * lens[1]) * aperture;
    const Vec3d way = point - on_lens;
    const double depth = dot(way, forward);
    if (!doubt.less(camera.near_clip, depth) || !doubt.less(depth, camera.far_clip)) return {};

    // All rays through one point of the plane in focus belong to one point of the film. A pinhole's is in focus anywhere.
    const double focus = aperture > 0.0 ? double(camera.focus_distance) : 1.0;
    const Vec3d focused = on_lens + way * (focus / depth) - Vec3d(camera.position);
    PlainView view{on_lens, depth, {}, 0.0};
    const double half_x = camera.half_width, half_y = camera.half_height;
    view.film[0] = (1.0 - dot(focused, right) / (focus * half_x)) / 2.0 * camera.film_width;
    view.film[1] = (1.0 - dot(focused, up) / (focus * half_y)) / 2.0 * camera.film_height;
    // A pixel of area A at distance 1 subtends A cos^3 at the lens.
    const double pixel = (2.0 * half_x / camera.film_width) * (2.0 * half_y / camera.film_height);
    view.film_density = 1.0 / (pixel * std::pow(depth / length(way), 3.0));
    return view;
}

struct PlainFilterChoice {
    int pixel;
    double weight; // f / its probability
};

// One of the pixels i whose filter f(x - i - 1/2) reaches film coordinate x, with probability |f| / sum of |f|.
inline PlainFilterChoice plain_filter_choice(const PixelFilter& filter, double x, double u, Doubt& doubt)
{
    const double radius = filter.radius;
    std::vector<std::pair<int, double>> values;
    double sum = 0.0;
    for (int pixel = int(std::floor(x - radius)) - 1; pixel <= int(x + radius) + 1; ++pixel) {
        const double bin = (x - pixel - 0.5 + radius) / (2.0 * radius) * FILTER_BINS;
        // Film coordinates are some tens of pixels, and half a bin less sure than numbers around 1.
        doubt.less(0.0, std::abs(bin - std::round(bin)), 1e-3);
        if (bin < 0.0 || bin >= FILTER_BINS) continue;
        values.emplace_back(pixel, filter.density[static_cast<std::size_t>(bin)]);
        sum += std::abs(values.back().second);
    }
    double below = 0.0;
    for (const auto& [pixel, value] : values) {
        below += std::abs(value);
        if (doubt.less(u, below / sum)) return {pixel, std::copysign(sum, value)};
    }
    return {values.back().first, std::copysign(sum, values.back().second)};
}

} // namespace sundog
