// WebP by its own library.
#include "base/errors.h"
#include "base/image_decoders.h"

#include <fstream>
#include <iterator>
#include <webp/decode.h>

namespace sundog {

namespace {

class WebpFile : public ImageFile {
public:
    WebpFile(const std::filesystem::path& file, std::uint64_t memory) : file_(file)
    {
        std::ifstream stream(file, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
        WebPBitstreamFeatures features;
        if (stream.bad() || WebPGetFeatures(data(), bytes_.size(), &features) != VP8_STATUS_OK) refuse_image(file, "it is not a whole WebP image");
        if (features.has_animation) refuse_image(file, "it is an animation: save one of its frames");
        header_.width = features.width;
        header_.height = features.height;
        header_.channels = {"R", "G", "B", "A"};
        if (!features.has_alpha) header_.channels.pop_back();
        header_.color_space = "sRGB";
        check_whole_image({static_cast<std::uint64_t>(features.width), static_cast<std::uint64_t>(features.height), header_.channels.size(), false}, memory,
                          bytes_.size(), file);
    }

    std::span<const float> next_row() override
    {
        const std::size_t row_samples = static_cast<std::size_t>(header_.width) * header_.channels.size();
        if (samples_.empty()) decode(row_samples);
        row_.clear();
        for (const std::uint8_t sample : std::span(samples_).subspan(y_++ * row_samples, row_samples)) row_.push_back(static_cast<float>(sample) / 255.0f);
        return row_;
    }

private:
    void decode(std::size_t row_samples)
    {
        samples_.resize(row_samples * static_cast<std::size_t>(header_.height));
        const auto decode_into = header_.channels.size() == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
        if (!decode_into(data(), bytes_.size(), samples_.data(), samples_.size(), static_cast<int>(row_samples))) refuse_image(file_, "its WebP data are damaged");
    }
    const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(bytes_.data()); }

    std::filesystem::path file_;
    std::string bytes_;
    std::vector<std::uint8_t> samples_;
    std::vector<float> row_;
    std::size_t y_ = 0;
};

} // namespace

std::unique_ptr<ImageFile> open_webp(const std::filesystem::path& file, std::uint64_t memory)
{
    return std::make_unique<WebpFile>(file, memory);
}

} // namespace sundog
