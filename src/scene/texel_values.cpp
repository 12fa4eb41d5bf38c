#include "scene/texel_values.h"

#include "math/double3.h"
#include "math/half.h"
#include "math/srgb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace sundog {

namespace {

const std::array<float, 256>& decoded_bytes()
{
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); i++) values[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
        return values;
    }();
    return table;
}

class Mean {
public:
    void add(Vec3 value)
    {
        value = max(value, Vec3{0, 0, 0});
        sum_ = {sum_[0] + value.x, sum_[1] + value.y, sum_[2] + value.z};
        count_++;
    }
    Vec3 value() const
    {
        const double scale = count_ == 0 ? 0.0 : 1.0 / static_cast<double>(count_);
        return {static_cast<float>(sum_[0] * scale), static_cast<float>(sum_[1] * scale), static_cast<float>(sum_[2] * scale)};
    }

private:
    Double3 sum_{};
    std::size_t count_ = 0;
};

struct MeanOfTexture {
    const Scene& scene;
    const TriangleMesh* mesh;

    Vec3 operator()(const BitmapTexture& bitmap) const
    {
        Mean mean;
        const std::size_t texels = bitmap.image->texels.size() / bitmap.image->words_per_texel();
        for (std::size_t i = 0; i < texels; i++) mean.add(linear_texel(*bitmap.image, i));
        return mean.value();
    }

    Vec3 operator()(const CheckerboardTexture& checkerboard) const
    {
        Mean mean;
        for (const ColorSource& color : checkerboard.colors) mean.add(color.texture ? color.value * mean_color(scene, *color.texture, mesh) : color.value);
        return mean.value();
    }

    Vec3 operator()(const AttributeTexture& attribute) const
    {
        Mean mean;
        if (mesh)
            for (const MeshAttribute& values : mesh->attributes)
                if (values.name == attribute.name)
                    for (const Vec3 value : values.values) mean.add(value);
        return mean.value();
    }
};

} // namespace

Vec3 linear_texel(TexelFormat format, const uint* words)
{
    if (format == TexelFormat::float32) return {std::bit_cast<float>(words[0]), std::bit_cast<float>(words[1]), std::bit_cast<float>(words[2])};
    if (format == TexelFormat::half) {
        const auto number = [](uint bits) { return float_from_half(static_cast<std::uint16_t>(bits)); };
        return {number(words[0] & 0xffff), number(words[0] >> 16), number(words[1] & 0xffff)};
    }
    const auto channel = [&](int shift) {
        const uint byte = (words[0] >> shift) & 0xff;
        return format == TexelFormat::srgb8 ? decoded_bytes()[byte] : static_cast<float>(byte) / 255.0f;
    };
    return {channel(0), channel(8), channel(16)};
}

Vec3 linear_texel(const TexelImage& image, std::size_t index)
{
    return linear_texel(image.format, &image.texels[index * image.words_per_texel()]);
}

bool is_of_bytes(TexelFormat format)
{
    return format == TexelFormat::srgb8 || format == TexelFormat::linear8;
}

void append_numbers(TexelFormat format, Vec3 texel, std::vector<uint>& texels)
{
    if (format == TexelFormat::half) {
        texels.push_back(half_from_float(texel.x) | static_cast<uint>(half_from_float(texel.y)) << 16);
        texels.push_back(half_from_float(texel.z));
    } else {
        for (const float value : {texel.x, texel.y, texel.z}) texels.push_back(std::bit_cast<uint>(value));
    }
}

void narrow(TexelImage& image)
{
    const auto fits = [](uint bits) { return std::abs(std::bit_cast<float>(bits)) <= largest_half; };
    if (image.format != TexelFormat::float32 || !std::all_of(image.texels.begin(), image.texels.end(), fits)) return;
    std::vector<uint> halves;
    halves.reserve(image.texels.size() / 3 * 2);
    for (std::size_t i = 0; i < image.texels.size(); i += 3) append_numbers(TexelFormat::half, linear_texel(image.format, &image.texels[i]), halves);
    image.texels = std::move(halves);
    image.format = TexelFormat::half;
}

Vec3 mean_color(const Scene& scene, uint texture, const TriangleMesh* mesh)
{
    return std::visit(MeanOfTexture{scene, mesh}, scene.textures[texture].model);
}

} // namespace sundog
