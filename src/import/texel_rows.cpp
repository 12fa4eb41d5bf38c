#include "import/texel_rows.h"

#include "math/srgb.h"
#include "scene/texel_values.h"

#include <algorithm>
#include <cmath>

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

} // namespace

HalvedRows::HalvedRows(int width, int height, TexelFormat format)
    : width_(width), height_(height), half_width_(std::max(1, width / 2)), half_height_(std::max(1, height / 2)), format_(format),
      sums_(static_cast<std::size_t>(half_width_))
{
}

bool HalvedRows::add(std::span<const uint> texels)
{
    const std::size_t words = words_per_texel(format_);
    for (int x = 0; x < half_width_; x++) {
        const int right = static_cast<int>((x + 1LL) * width_ / half_width_);
        // In double precision, for the sum of floats may be beyond a float.
        Double3& sum = sums_[static_cast<std::size_t>(x)];
        for (int i = static_cast<int>(static_cast<long long>(x) * width_ / half_width_); i < right; i++) {
            const Vec3 texel = linear_texel(format_, &texels[static_cast<std::size_t>(i) * words]);
            sum = {sum[0] + texel.x, sum[1] + texel.y, sum[2] + texel.z};
        }
    }
    y_++;
    if (y_ < (half_y_ + 1LL) * height_ / half_height_) return false;
    finish_row();
    return true;
}

void HalvedRows::finish_row()
{
    row_.clear();
    for (int x = 0; x < half_width_; x++) {
        const long long columns = (x + 1LL) * width_ / half_width_ - static_cast<long long>(x) * width_ / half_width_;
        const double count = static_cast<double>(columns) * (y_ - first_);
        const Double3& sum = sums_[static_cast<std::size_t>(x)];
        const Double3 mean{sum[0] / count, sum[1] / count, sum[2] / count};
        if (is_of_bytes(format_))
            row_.push_back(packed_bytes(format_, mean));
        else
            append_numbers(format_, {static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2])}, row_);
    }
    std::fill(sums_.begin(), sums_.end(), Double3{});
    first_ = y_;
    half_y_++;
}

TexelRows::TexelRows(int width, int height, TexelFormat format, int halvings)
{
    image_.width = width;
    image_.height = height;
    image_.format = format;
    for (int i = 0; i < halvings; i++) {
        steps_.emplace_back(image_.width, image_.height, format);
        image_.width = steps_.back().width();
        image_.height = steps_.back().height();
    }
}

void TexelRows::add(std::span<const uint> texels)
{
    for (HalvedRows& step : steps_) {
        if (!step.add(texels)) return;
        texels = step.row();
    }
    image_.texels.insert(image_.texels.end(), texels.begin(), texels.end());
}

TexelImage TexelRows::image()
{
    return std::move(image_);
}

} // namespace sundog
