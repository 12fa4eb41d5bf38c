#include "import/texture_budget.h"

#include "math/double3.h"
#include "math/srgb.h"
#include "scene/texel_values.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sundog
{

namespace
{

// Of 8 bits a channel.
uint packed_bytes(TexelFormat format, const Double3& color)
{
    const auto byte = [&](double linear) -> uint {
        if (format == TexelFormat::srgb8) return srgb8_from_linear(static_cast<float>(linear));
        return static_cast<uint>(std::lround(255.0 * std::clamp(linear, 0.0, 1.0)));
    };
    return byte(color[0]) | byte(color[1]) << 8 | byte(color[2]) << 16;
}

bool is_of_bytes(TexelFormat format)
{
    return format == TexelFormat::srgb8 || format == TexelFormat::linear8;
}

// Of the texels of a rectangle. In double precision, for the sum of floats may be beyond a float.
Double3 mean_texel(const TexelImage& image, int left, int top, int right, int bottom)
{
    Double3 sum{};
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            const Vec3 texel =
                linear_texel(image, static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
            sum = {sum[0] + texel.x, sum[1] + texel.y, sum[2] + texel.z};
        }
    }
    const double count = static_cast<double>(right - left) * (bottom - top);
    return {sum[0] / count, sum[1] / count, sum[2] / count};
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
    std::vector<float> values; // of what is not bytes
    for (int y = 0; y < half.height; y++) {
        const int top = y * image.height / half.height, bottom = (y + 1) * image.height / half.height;
        for (int x = 0; x < half.width; x++) {
            const Double3 mean = mean_texel(image, x * image.width / half.width, top, (x + 1) * image.width / half.width, bottom);
            if (is_of_bytes(half.format))
                half.texels.push_back(packed_bytes(half.format, mean));
            else
                for (const double channel : mean) values.push_back(static_cast<float>(channel));
        }
    }
    if (!is_of_bytes(half.format)) set_linear_texels(half, values);
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
