// An image that lights throw, and its values in plain double precision.
#pragma once

#include "scene/scene.h"
#include "support/double3.h"

#include <bit>
#include <cmath>
#include <memory>
#include <random>

namespace sundog
{

// Linear floats between 0 and 4, a fifth of them black.
inline std::shared_ptr<const TexelImage> light_image(int width, int height, uint seed = 3)
{
    TexelImage image{width, height, TexelFormat::float32, {}};
    std::mt19937 random(seed);
    for (int i = 0; i < width * height; ++i) {
        const bool black = random() % 5 == 0;
        for (int c = 0; c < 3; ++c) image.texels.push_back(std::bit_cast<uint>(black ? 0.0f : 4.0f * static_cast<float>(random() % 1000) / 1000.0f));
    }
    return std::make_shared<const TexelImage>(std::move(image));
}

// Appends a bitmap that is clamped at its edges; gives its index.
inline uint add_light_image(Scene& scene, std::shared_ptr<const TexelImage> image)
{
    TextureDescription texture;
    texture.model = BitmapTexture{std::move(image), WrapMode::clamp, WrapMode::clamp, TextureFilter::bilinear};
    scene.textures.push_back(texture);
    return static_cast<uint>(scene.textures.size() - 1);
}

// Red, bilinear between the centres of texels, v down the rows.
inline double plain_image(const TexelImage& image, double u, double v)
{
    const double x = u * image.width - 0.5, y = v * image.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto texel = [&](double i, double j) {
        const auto column = static_cast<std::size_t>(std::clamp(i, 0.0, image.width - 1.0)), row = static_cast<std::size_t>(std::clamp(j, 0.0, image.height - 1.0));
        return static_cast<double>(std::bit_cast<float>(image.texels[3 * (row * static_cast<std::size_t>(image.width) + column)]));
    };
    const double tx = x - left, ty = y - top;
    return (texel(left, top) * (1 - tx) + texel(left + 1, top) * tx) * (1 - ty) + (texel(left, top + 1) * (1 - tx) + texel(left + 1, top + 1) * tx) * ty;
}

} // namespace sundog
