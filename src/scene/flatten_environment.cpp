#include "scene/flatten_environment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace sundog {

namespace {

constexpr double pi = std::numbers::pi;

int patch_rows(const TexelImage& image)
{
    return std::max(image.height - 1, 1);
}

// Row by row, weights proportional to the chance of each patch (kernels/shared/environment.h): its solid angle is
// 2 sin(middle polar angle) sin(half its height) times its width in azimuth.
std::vector<double> patch_weights(const TexelImage& image)
{
    const auto width = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(patch_rows(image));
    const auto luminance_at = [&](std::size_t x, std::size_t y) {
        const uint* texel = &image.texels[3 * (std::min(y, static_cast<std::size_t>(image.height) - 1) * width + x)];
        return 0.2126 * std::bit_cast<float>(texel[0]) + 0.7152 * std::bit_cast<float>(texel[1]) + 0.0722 * std::bit_cast<float>(texel[2]);
    };
    std::vector<double> weights(width * rows);
    for (std::size_t y = 0; y < rows; y++) {
        const double sine = std::sin(pi * (static_cast<double>(y) + 0.5) / static_cast<double>(rows));
        for (std::size_t x = 0; x < width; x++) {
            const std::size_t right = (x + 1) % width;
            weights[y * width + x] =
                0.25 * sine * (luminance_at(x, y) + luminance_at(right, y) + luminance_at(x, y + 1) + luminance_at(right, y + 1));
        }
    }
    return weights;
}

double sum(const std::vector<double>& values)
{
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
}

} // namespace

double mean_luminance(const EnvironmentEmitter& environment)
{
    const TexelImage& image = *environment.image;
    // The sines of a row's middles add up to 1 / sin(half a row).
    return sum(patch_weights(image)) * std::sin(0.5 * pi / patch_rows(image)) / image.width;
}

uint append_environment(const EnvironmentEmitter& environment, const SourceLocation& where, FlatScene& flat)
{
    const TexelImage& image = *environment.image;
    if (flat.texels.size() + image.texels.size() > std::numeric_limits<uint>::max())
        throw SceneError(where, "the textures hold more texels than 32-bit numbers can count: scale some down");
    EnvironmentMap map{};
    map.axis_x = environment.axis_x;
    map.axis_y = environment.axis_y;
    map.axis_z = environment.axis_z;
    map.width = static_cast<uint>(image.width);
    map.height = static_cast<uint>(image.height);
    map.first_texel = static_cast<uint>(flat.texels.size());
    map.rows = static_cast<uint>(patch_rows(image));
    flat.texels.insert(flat.texels.end(), image.texels.begin(), image.texels.end());
    const std::vector<double> weights = patch_weights(image);
    // Uniform in azimuth and polar angle within a patch of 2 pi / width by pi / rows.
    map.pdf_scale = static_cast<float>(static_cast<double>(map.width) * map.rows / (2.0 * pi * pi * sum(weights)));
    std::vector<float> probabilities;
    flat.environment_alias = make_alias_table(weights, probabilities);
    flat.environment_maps.push_back(map);
    return static_cast<uint>(flat.environment_maps.size() - 1);
}

} // namespace sundog
