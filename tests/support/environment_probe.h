// An environment map in plain double precision: what the kernels' lookups and densities are held against.
#pragma once

#include "math/transform.h"
#include "scene/scene.h"
#include "support/double3.h"

#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace sundog
{

// Texels of exponential brightness, a fifth of them black, one 3000 times as bright: beyond what half floats hold
// in the sum, as a sun is.
inline std::shared_ptr<const TexelImage> random_environment(int width, int height, float sun = 3000.0f)
{
    TexelImage image;
    image.width = width;
    image.height = height;
    image.format = TexelFormat::float32;
    std::mt19937 random(7);
    for (int i = 0; i < 3 * width * height; ++i) {
        const double u = (static_cast<double>(random()) + 0.5) / 4294967296.0;
        float value = random() % 5 == 0 ? 0.0f : static_cast<float>(-std::log(u));
        if (i / 3 == width * (height / 3) + width / 3) value *= sun;
        image.texels.push_back(std::bit_cast<uint>(value));
    }
    return std::make_shared<const TexelImage>(std::move(image));
}

// Turned about an axis that is none of the world's.
inline EnvironmentEmitter turned_environment(std::shared_ptr<const TexelImage> image, float scale = 1.0f)
{
    const Transform turn = Transform::rotate({1, 2, 3}, 70);
    return {std::move(image), scale, turn.vector({1, 0, 0}), turn.vector({0, 1, 0}), turn.vector({0, 0, 1})};
}

class PlainEnvironment
{
public:
    explicit PlainEnvironment(EnvironmentEmitter emitter) : emitter_(std::move(emitter)), image_(*emitter_.image), rows_(std::max(image_.height - 1, 1))
    {
        for (int y = 0; y < rows_; ++y)
            for (int x = 0; x < image_.width; ++x) total_ += weight(x, y);
    }

    // Of channel 0, with Mitsuba's orientation (its `envmap`: u = atan2(x, -z) / 2 pi, v = acos(y) / pi).
    double radiance(Vec3d direction) const
    {
        const Place p = place(direction);
        const double above = texel(p.x, p.y, 0) * (1 - p.tx) + texel(p.x + 1, p.y, 0) * p.tx;
        const double below = texel(p.x, p.y + 1, 0) * (1 - p.tx) + texel(p.x + 1, p.y + 1, 0) * p.tx;
        return emitter_.scale * (above * (1 - p.ty) + below * p.ty);
    }

    // 1/sr
    double density(Vec3d direction) const
    {
        const Place p = place(direction);
        return weight(p.x, p.y) / total_ * image_.width * rows_ / (2 * std::numbers::pi * std::numbers::pi * p.sine);
    }

    // Integral of f(direction, radiance) over the sphere by the midpoint rule: `fine` x `fine` points a patch.
    template <class F> double integrate(F f, int fine = 24) const
    {
        double sum = 0.0;
        const int columns = image_.width * fine, rows = rows_ * fine;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const double phi = 2 * std::numbers::pi * (i + 0.5) / columns, theta = std::numbers::pi * (j + 0.5) / rows;
                const Vec3d local{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
                const Vec3d d = Vec3d(emitter_.axis_x) * local.x + Vec3d(emitter_.axis_y) * local.y + Vec3d(emitter_.axis_z) * local.z;
                sum += f(d, radiance(d)) * std::sin(theta);
            }
        return sum * 2 * std::numbers::pi * std::numbers::pi / (static_cast<double>(columns) * rows);
    }

private:
    struct Place {
        int x, y;
        double tx, ty, sine;
    };

    Place place(Vec3d d) const
    {
        const double x = dot(d, Vec3d(emitter_.axis_x)), y = dot(d, Vec3d(emitter_.axis_y)), z = dot(d, Vec3d(emitter_.axis_z));
        double u = std::atan2(x, -z) / (2 * std::numbers::pi);
        u -= std::floor(u);
        const double sine = std::hypot(x, z);
        const double column = u * image_.width - 0.5, row = std::atan2(sine, y) / std::numbers::pi * rows_;
        const double left = std::floor(column), top = std::min(std::floor(row), rows_ - 1.0);
        return {static_cast<int>(left), static_cast<int>(top), column - left, row - top, sine};
    }

    double texel(int x, int y, int channel) const
    {
        const int column = (x + image_.width) % image_.width, row = std::min(y, image_.height - 1);
        return std::bit_cast<float>(image_.texels[3 * static_cast<std::size_t>(row * image_.width + column) + static_cast<std::size_t>(channel)]);
    }

    double weight(int x, int y) const
    {
        const double factors[] = {0.2126, 0.7152, 0.0722};
        double luminance = 0.0;
        for (int c = 0; c < 3; ++c) luminance += factors[c] * (texel(x, y, c) + texel(x + 1, y, c) + texel(x, y + 1, c) + texel(x + 1, y + 1, c));
        return luminance * std::sin(std::numbers::pi * (y + 0.5) / rows_);
    }

    EnvironmentEmitter emitter_;
    const TexelImage& image_;
    int rows_;
    double total_ = 0.0;
};

} // namespace sundog
