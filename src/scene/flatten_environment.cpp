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
std::vector<double> patch_weights(const TexelImage& image, double polar_range)
{
    const auto width = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(patch_rows(image));
    const auto luminance_at = [&](std::size_t x, std::size_t y) {
        const uint* texel = &image.texels[3 * (std::min(y, static_cast<std::size_t>(image.height) - 1) * width + x)];
        return 0.2126 * std::bit_cast<float>(texel[0]) + 0.7152 * std::bit_cast<float>(texel[1]) + 0.0722 * std::bit_cast<float>(texel[2]);
    };
    std::vector<double> weights(width * rows);
    for (std::size_t y = 0; y < rows; y++) {
        const double sine = std::sin(polar_range * (static_cast<double>(y) + 0.5) / static_cast<double>(rows));
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

// Without the scale.
double dome_luminance(const TexelImage& image, double polar_range)
{
    // A patch's solid angle is 2 sin(half a row) times the sine of its middle times its width. Of a whole sphere, the sines of a
    // row's middles add up to 1 / sin(half a row).
    return sum(patch_weights(image, polar_range)) * std::sin(0.5 * polar_range / patch_rows(image)) / image.width;
}

double sun_luminance(const SunDisk& sun)
{
    return sun.mean_luminance * 0.5 * static_cast<double>(sun.one_minus_cos); // of 4 pi, it fills 2 pi (1 - cos)
}

// The index of the first of them.
uint append_texels(const TexelImage& image, const SourceLocation& where, FlatScene& flat)
{
    if (flat.texels.size() + image.texels.size() > std::numeric_limits<uint>::max())
        throw SceneError(where, "the textures hold more texels than 32-bit numbers can count: scale some down");
    const auto first = static_cast<uint>(flat.texels.size());
    flat.texels.insert(flat.texels.end(), image.texels.begin(), image.texels.end());
    return first;
}

// Half of all choices go evenly to sun and sky, half by power, as those among distant lights do: what the sun does not reach is
// lit by the sky alone.
float sun_share(double sun, double all)
{
    return sun >= all ? 1.0f : static_cast<float>(0.25 + 0.5 * sun / all);
}

void set_sun(const SunDisk& sun, double all, const SourceLocation& where, FlatScene& flat, EnvironmentMap& map)
{
    map.sun_direction = sun.direction;
    map.sun_tangent = sun.tangent;
    map.sun_one_minus_cos = sun.one_minus_cos;
    map.sun_share = sun_share(sun_luminance(sun), all);
    map.sun_width = static_cast<uint>(sun.image->width);
    map.sun_first_texel = append_texels(*sun.image, where, flat);
}

} // namespace

double mean_luminance(const EnvironmentEmitter& environment)
{
    return dome_luminance(*environment.image, pi);
}

double mean_luminance(const Surroundings& surroundings)
{
    const double dome = dome_luminance(*surroundings.dome.image, surroundings.polar_range);
    return surroundings.sun ? dome + sun_luminance(*surroundings.sun) : dome;
}

uint append_environment(const Surroundings& surroundings, const SourceLocation& where, FlatScene& flat)
{
    const EnvironmentEmitter& environment = surroundings.dome;
    const TexelImage& image = *environment.image;
    EnvironmentMap map{};
    map.axis_x = environment.axis_x;
    map.axis_y = environment.axis_y;
    map.axis_z = environment.axis_z;
    map.width = static_cast<uint>(image.width);
    map.height = static_cast<uint>(image.height);
    map.first_texel = append_texels(image, where, flat);
    map.rows = static_cast<uint>(patch_rows(image));
    map.polar_range = static_cast<float>(surroundings.polar_range);
    map.inverse_polar_range = static_cast<float>(1.0 / surroundings.polar_range);
    std::vector<double> weights = patch_weights(image, surroundings.polar_range);
    double total = sum(weights);
    if (!(total > 0.0)) { // the sun alone: the image is never chosen
        std::fill(weights.begin(), weights.end(), 1.0);
        total = sum(weights);
    }
    // Uniform in azimuth and polar angle within a patch of 2 pi / width by polar range / rows.
    map.pdf_scale = static_cast<float>(static_cast<double>(map.width) * map.rows / (2.0 * pi * surroundings.polar_range * total));
    if (surroundings.sun) set_sun(*surroundings.sun, mean_luminance(surroundings), where, flat, map);
    std::vector<float> probabilities;
    flat.environment_alias = make_alias_table(weights, probabilities);
    flat.environment_maps.push_back(map);
    return static_cast<uint>(flat.environment_maps.size() - 1);
}

} // namespace sundog
