#include "import/texture_budget.h"

#include "math/half.h"
#include "math/srgb.h"
#include "scene/texel_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace sundog
{

namespace
{

void append_texel(TexelImage& image, Vec3 color)
{
    if (image.format == TexelFormat::float32) {
        for (const float channel : {color.x, color.y, color.z}) image.texels.push_back(std::bit_cast<uint>(channel));
        return;
    }
    if (image.format == TexelFormat::half) {
        image.texels.push_back(half_from_float(color.x) | static_cast<uint>(half_from_float(color.y)) << 16);
        image.texels.push_back(half_from_float(color.z));
        return;
    }
    const auto byte = [&](float linear) -> uint {
        if (image.format == TexelFormat::srgb8) return srgb8_from_linear(linear);
        return static_cast<uint>(std::lround(255.0f * std::clamp(linear, 0.0f, 1.0f)));
    };
    image.texels.push_back(byte(color.x) | byte(color.y) << 8 | byte(color.z) << 16);
}

std::uint64_t bytes_of(const TexelImage& image)
{
    return image.texels.size() * sizeof(uint);
}

std::string size_of(const TexelImage& image)
{
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

// A bitmap, the textures that use it, and what it has become.
struct Shrinking {
    std::shared_ptr<const TexelImage> original, current;
    std::vector<BitmapTexture*> users;
    SourceLocation where;
};

std::vector<Shrinking> distinct_bitmaps(Scene& scene)
{
    std::vector<Shrinking> bitmaps;
    std::map<const TexelImage*, std::size_t> known;
    for (auto& texture : scene.textures) {
        auto* bitmap = std::get_if<BitmapTexture>(&texture.model);
        if (!bitmap) continue;
        const auto [entry, added] = known.emplace(bitmap->image.get(), bitmaps.size());
        if (added) bitmaps.push_back({bitmap->image, bitmap->image, {}, texture.where});
        bitmaps[entry->second].users.push_back(bitmap);
    }
    return bitmaps;
}

} // namespace

TexelImage halved(const TexelImage& image)
{
    TexelImage half;
    half.format = image.format;
    half.width = std::max(1, image.width / 2);
    half.height = std::max(1, image.height / 2);
    half.texels.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) * image.words_per_texel());
    for (int y = 0; y < half.height; y++) {
        const int top = y * image.height / half.height, bottom = (y + 1) * image.height / half.height;
        for (int x = 0; x < half.width; x++) {
            const int left = x * image.width / half.width, right = (x + 1) * image.width / half.width;
            Vec3 sum{0, 0, 0};
            for (int j = top; j < bottom; j++)
                for (int i = left; i < right; i++) sum = sum + linear_texel(image, static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(i));
            append_texel(half, sum / static_cast<float>((right - left) * (bottom - top)));
        }
    }
    return half;
}

void fit_texture_budget(Scene& scene, std::uint64_t budget, std::vector<Warning>& warnings)
{
    std::vector<Shrinking> bitmaps = distinct_bitmaps(scene);
    std::uint64_t total = 0;
    for (const auto& bitmap : bitmaps) total += bytes_of(*bitmap.current);
    const auto smaller = [](const Shrinking& a, const Shrinking& b) { return bytes_of(*a.current) < bytes_of(*b.current); };
    while (total > budget) {
        const auto largest = std::max_element(bitmaps.begin(), bitmaps.end(), smaller);
        if (largest->current->width == 1 && largest->current->height == 1) break;
        total -= bytes_of(*largest->current);
        largest->current = std::make_shared<const TexelImage>(halved(*largest->current));
        total += bytes_of(*largest->current);
    }
    for (const auto& bitmap : bitmaps) {
        if (bitmap.current == bitmap.original) continue;
        for (BitmapTexture* user : bitmap.users) user->image = bitmap.current;
        warnings.emplace_back(bitmap.where.prefix() + "the bitmap was scaled down from " + size_of(*bitmap.original) + " to " + size_of(*bitmap.current) +
                           " texels to keep all within " + std::to_string(budget / 1'000'000) + " MB: --texture-memory allows more",
                              WarningKind::approximated);
    }
}

} // namespace sundog
