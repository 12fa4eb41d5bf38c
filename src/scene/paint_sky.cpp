#include "scene/paint_sky.h"

#include "math/double3.h"
#include "scene/clear_sky.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

constexpr double pi = std::numbers::pi, half_pi = 0.5 * pi;
// Linear interpolation between texels: at this resolution it errs by up to 6 % in the last quarter of a degree above the horizon,
// where the model's slope has no bound, and by less than 0.2 % from one degree on.
constexpr int sky_width = 1024;
constexpr int rows_above_horizon = 384;
constexpr int sun_width = 128;

Double3 to_double(Vec3 v)
{
    return {v.x, v.y, v.z};
}

Vec3 unit(const Double3& v)
{
    const double inverse = 1.0 / std::sqrt(dot(v, v));
    return {static_cast<float>(v[0] * inverse), static_cast<float>(v[1] * inverse), static_cast<float>(v[2] * inverse)};
}

// The image's frame: y is up, the middle column (z) below the sun.
struct Frame {
    Vec3 x, y, z;
};

Frame frame_below_sun(const SunSkyEmitter& emitter)
{
    const Double3 up = to_double(emitter.up), sun = to_double(emitter.sun_direction);
    Double3 aside = cross(up, sun);
    if (dot(aside, aside) < 1e-12) aside = cross(up, std::abs(up[0]) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}); // at the zenith
    const Vec3 x = unit(aside);
    return {x, emitter.up, unit(cross(to_double(x), up))};
}

void append(std::vector<uint>& texels, Vec3 color)
{
    for (const float channel : {color.x, color.y, color.z}) texels.push_back(std::bit_cast<uint>(channel));
}

double luminance_of(Vec3 color)
{
    return 0.2126 * static_cast<double>(color.x) + 0.7152 * static_cast<double>(color.y) + 0.0722 * static_cast<double>(color.z);
}

// As the model has it, without the stretch.
double sun_polar_angle(const SunSkyEmitter& emitter)
{
    return std::acos(std::clamp(dot(to_double(emitter.up), to_double(emitter.sun_direction)), 0.0, 1.0));
}

TexelImage black_image()
{
    return {1, 1, TexelFormat::float32, std::vector<uint>(3, 0)};
}

TexelImage paint_dome(const SunSkyEmitter& emitter, const ClearSky& sky, double polar_range)
{
    if (emitter.sky_scale == 0.0f) return black_image();
    TexelImage image{sky_width, 1 + static_cast<int>(std::lround(rows_above_horizon * polar_range / half_pi)), TexelFormat::float32, {}};
    const double sun_polar = sun_polar_angle(emitter);
    for (int row = 0; row < image.height; row++) {
        const double polar = std::min(polar_range * row / (image.height - 1) / emitter.stretch, half_pi);
        for (int column = 0; column < image.width; column++) {
            const double azimuth = 2.0 * pi * (column + 0.5) / image.width - pi; // from the sun's
            const double cos_gamma = std::cos(polar) * std::cos(sun_polar) + std::sin(polar) * std::sin(sun_polar) * std::cos(azimuth);
            const double cosine = polar < half_pi ? std::cos(polar) : 0.0;
            append(image.texels, sky.sky(cosine, std::acos(std::clamp(cos_gamma, -1.0, 1.0))) * emitter.sky_scale);
        }
    }
    return image;
}

// The rim of the disk is on the edges of the square of side 2; radii are sines of the angle to the middle.
SunDisk paint_sun(const SunSkyEmitter& emitter, const ClearSky& sky, const Frame& frame)
{
    const double half_angle = 0.5 * emitter.sun_aperture * pi / 180.0, rim = std::sin(half_angle);
    const double sun_polar = sun_polar_angle(emitter), polar = sun_polar * emitter.stretch;
    SunDisk sun;
    sun.direction =
        unit({std::sin(polar) * frame.z.x + std::cos(polar) * frame.y.x, std::sin(polar) * frame.z.y + std::cos(polar) * frame.y.y,
              std::sin(polar) * frame.z.z + std::cos(polar) * frame.y.z});
    if (emitter.stretch == 1.0f) sun.direction = emitter.sun_direction;
    sun.tangent = unit(cross(cross(to_double(sun.direction), to_double(frame.x)), to_double(sun.direction)));
    sun.one_minus_cos = static_cast<float>(2.0 * std::pow(std::sin(0.5 * half_angle), 2.0));
    // The power of the sun as it is is spread over the disk.
    const double spread = std::pow(std::sin(0.5 * sun_half_angle) / std::sin(0.5 * half_angle), 2.0);
    const auto scale = static_cast<float>(spread * emitter.sun_scale);

    TexelImage image{sun_width, sun_width, TexelFormat::float32, {}};
    std::vector<Vec3> colors;
    Double3 sum{};
    int inside = 0;
    for (int row = 0; row < sun_width; row++) {
        for (int column = 0; column < sun_width; column++) {
            const double x = 2.0 * column / (sun_width - 1) - 1.0, y = 2.0 * row / (sun_width - 1) - 1.0, r2 = x * x + y * y;
            // Rows go upwards.
            const double height = std::cos(sun_polar) * std::sqrt(std::max(1.0 - r2 * rim * rim, 0.0)) + std::sin(sun_polar) * y * rim;
            const double elevation = std::asin(std::clamp(height, -1.0, 1.0));
            const bool risen = elevation >= 0.0 || emitter.extend;
            colors.push_back(risen ? sky.sun(std::max(elevation, 0.0), std::sqrt(std::max(1.0 - r2, 0.0))) * scale : Vec3{0, 0, 0});
            if (r2 > 1.0) continue;
            inside++;
            const Double3 color = to_double(colors.back());
            for (std::size_t c = 0; c < 3; c++) sum[c] += color[c];
        }
    }
    const Vec3 mean{static_cast<float>(sum[0] / inside), static_cast<float>(sum[1] / inside), static_cast<float>(sum[2] / inside)};
    for (const Vec3& color : colors) append(image.texels, emitter.limb_darkening ? color : mean);
    sun.mean_luminance = luminance_of(mean);
    sun.image = std::make_shared<const TexelImage>(std::move(image));
    return sun;
}

} // namespace

Surroundings paint_sky(const SunSkyEmitter& emitter)
{
    const ClearSky sky(emitter.turbidity, emitter.albedo, half_pi - sun_polar_angle(emitter));
    const Frame frame = frame_below_sun(emitter);
    Surroundings surroundings;
    surroundings.polar_range = emitter.extend ? pi : half_pi * emitter.stretch;
    surroundings.dome.image = std::make_shared<const TexelImage>(paint_dome(emitter, sky, surroundings.polar_range));
    surroundings.dome.axis_x = frame.x;
    surroundings.dome.axis_y = frame.y;
    surroundings.dome.axis_z = frame.z;
    if (emitter.sun_scale > 0.0f) {
        SunDisk sun = paint_sun(emitter, sky, frame);
        if (sun.mean_luminance > 0.0) surroundings.sun = std::move(sun);
    }
    return surroundings;
}

} // namespace sundog
