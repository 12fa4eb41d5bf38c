#include "import/bitmap.h"

#include "base/image_file.h"
#include "import/texel_rows.h"
#include "math/half.h"
#include "math/srgb.h"
#include "scene/color_channels.h"
#include "scene/texel_values.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

namespace sundog
{

namespace
{

// How a sample of a file becomes a linear number.
struct Decoding {
    enum class Curve { none, srgb, power };
    Curve curve = Curve::none;
    float gamma = 1.0f;

    float operator()(float value) const
    {
        if (curve == Curve::none) return value;
        if (curve == Curve::srgb) return linear_from_srgb(value);
        return std::copysign(std::pow(std::abs(value), gamma), value);
    }
};

Decoding decoding_of(const BitmapRequest& request, SampleType type)
{
    if (request.gamma == -1.0) return {Decoding::Curve::srgb};
    if (request.gamma == 1.0) return {};
    if (request.gamma > 0.0) return {Decoding::Curve::power, static_cast<float>(request.gamma)};
    if (request.raw || type == SampleType::real) return {};
    return {Decoding::Curve::srgb};
}

struct WantedChannels {
    ColorChannels color;
    Decoding decoding;
};

WantedChannels wanted_channels(const BitmapRequest& request, const ImageHeader& header)
{
    const Decoding decoding = decoding_of(request, header.type);
    if (request.channel.empty()) return {color_channels(header.channels, request.file), decoding};
    const auto found = find_channel(header.channels, request.channel);
    if (!found)
        throw FileError(request.file.string() + ": the image has no channel '" + request.channel + "'; its channels are " +
                        list_of_channels(header.channels));
    const bool is_alpha = find_channel(header.channels, "a") == found; // which no format encodes
    return {{ColorChannels::Model::rgb, {*found, *found, *found}, {}}, is_alpha ? Decoding{} : decoding};
}

// What a texel may be; counts what it may not.
class Repairs
{
public:
    explicit Repairs(bool light) : light_(light) {}

    float finite(float value)
    {
        if (std::isnan(value)) {
            counts_.nan++;
            return 0.0f;
        }
        if (light_ && value < 0.0f) {
            counts_.negative++;
            return 0.0f;
        }
        if (std::isinf(value)) {
            counts_.infinite++;
            return light_ ? 0.0f : std::copysign(largest_half, value);
        }
        if (std::abs(value) > largest_texel) {
            counts_.huge++;
            return std::copysign(largest_texel, value);
        }
        return value;
    }
    const TexelRepairs& counts() const { return counts_; }

private:
    bool light_; // wanted
    TexelRepairs counts_;
};

// Of a row of samples, the texels.
class TexelRow
{
public:
    TexelRow(const WantedChannels& wanted, std::size_t channels, TexelFormat format, bool light)
        : wanted_(wanted), channels_(channels), format_(format), repairs_(light)
    {
    }

    // False where a value is beyond what the format holds.
    bool fill(std::span<const float> samples)
    {
        texels_.clear();
        const auto [r, g, b] = wanted_.color.index;
        for (std::size_t i = 0; i < samples.size(); i += channels_) {
            if (is_of_bytes(format_)) {
                texels_.push_back(packed_bytes(samples[i + r], samples[i + g], samples[i + b]));
                continue;
            }
            const Decoding& decode = wanted_.decoding;
            const Vec3 color = wanted_.color.color({decode(samples[i + r]), decode(samples[i + g]), decode(samples[i + b])});
            const Vec3 texel{repairs_.finite(color.x), repairs_.finite(color.y), repairs_.finite(color.z)};
            if (format_ == TexelFormat::half && std::max({std::abs(texel.x), std::abs(texel.y), std::abs(texel.z)}) > largest_half) return false;
            append_numbers(format_, texel, texels_);
        }
        return true;
    }

    const std::vector<uint>& texels() const { return texels_; }
    const TexelRepairs& repairs() const { return repairs_.counts(); }

private:
    static uint packed_bytes(float r, float g, float b)
    {
        const auto byte = [](float value) { return static_cast<uint>(255.0f * value + 0.5f); };
        return byte(r) | byte(g) << 8 | byte(b) << 16;
    }

    WantedChannels wanted_;
    std::size_t channels_;
    TexelFormat format_;
    Repairs repairs_;
    std::vector<uint> texels_;
};

std::uint64_t bytes_of(int width, int height, TexelFormat format)
{
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * words_per_texel(format) * sizeof(uint);
}

int halvings_within(const ImageHeader& header, TexelFormat format, std::uint64_t memory)
{
    int count = 0;
    for (int width = header.width, height = header.height; bytes_of(width, height, format) > memory && (width > 1 || height > 1); count++) {
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
    return count;
}

// Nothing where a value is beyond what the format holds.
std::optional<LoadedBitmap> read_as(TexelFormat format, ImageFile& file, const BitmapRequest& request, bool light, std::uint64_t memory)
{
    const ImageHeader& header = file.header();
    TexelRow row(wanted_channels(request, header), header.channels.size(), format, light);
    TexelRows rows(header.width, header.height, format, halvings_within(header, format, memory));
    for (int y = 0; y < header.height; y++) {
        if (!row.fill(file.next_row())) return {};
        rows.add(row.texels());
    }
    return LoadedBitmap{rows.image(), header.width, header.height, row.repairs()};
}

// Bytes where they can stay as they are, else numbers.
TexelFormat first_format(const BitmapRequest& request, const ImageHeader& header)
{
    const WantedChannels wanted = wanted_channels(request, header);
    if (header.type != SampleType::byte || wanted.color.model != ColorChannels::Model::rgb) return TexelFormat::half;
    if (wanted.decoding.curve == Decoding::Curve::power) return TexelFormat::half;
    return wanted.decoding.curve == Decoding::Curve::srgb ? TexelFormat::srgb8 : TexelFormat::linear8;
}

template <class Load> LoadedBitmap with_location(const BitmapRequest& request, const SourceLocation& wanted_at, const Load& load)
{
    try {
        return load();
    } catch (const FileError& error) {
        throw SceneError(wanted_at, error.what());
    } catch (const std::bad_alloc&) {
        throw SceneError(wanted_at, request.file.string() + ": there is not enough memory for the image: scale it down, or give a smaller --texture-memory");
    }
}

} // namespace

std::string TexelRepairs::text() const
{
    std::string list;
    for (const auto& [count, what] : {std::pair(nan, " NaN"), std::pair(infinite, " infinite"), std::pair(huge, " beyond 1e30"), std::pair(negative, " negative")})
        if (count > 0) list += (list.empty() ? "" : ", ") + std::to_string(count) + what;
    return list;
}

LoadedBitmap load_bitmap(const BitmapRequest& request, const SourceLocation& wanted_at, std::uint64_t memory)
{
    return with_location(request, wanted_at, [&] {
        const auto file = open_image(request.file, memory);
        if (auto bitmap = read_as(first_format(request, file->header()), *file, request, false, memory)) return *std::move(bitmap);
        LoadedBitmap floats = *read_as(TexelFormat::float32, *open_image(request.file, memory), request, false, memory);
        narrow(floats.image);
        return floats;
    });
}

LoadedBitmap load_environment(const BitmapRequest& request, const SourceLocation& wanted_at, std::uint64_t memory)
{
    return with_location(request, wanted_at, [&] { return *read_as(TexelFormat::float32, *open_image(request.file, memory), request, true, memory); });
}

} // namespace sundog
