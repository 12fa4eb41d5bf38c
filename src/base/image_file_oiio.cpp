// Image files through OpenImageIO.
#include "base/errors.h"
#include "base/image_decoders.h"
#include "base/regular_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <new>
#include <stdexcept>

namespace sundog {

namespace {

constexpr std::size_t block_samples = std::size_t{1} << 22;

SampleType sample_type(const OIIO::TypeDesc& type)
{
    if (type.is_floating_point()) return SampleType::real;
    return type.basesize() == 1 ? SampleType::byte : SampleType::integer;
}

class OpenImageIoFile : public ImageFile {
public:
    OpenImageIoFile(const std::filesystem::path& file, std::uint64_t memory, std::uint64_t file_bytes) : file_(file)
    {
        OIIO::ImageSpec wish;
        wish.attribute("oiio:UnassociatedAlpha", 1);
        input_ = OIIO::ImageInput::open(file.string(), &wish);
        if (!input_) refuse_image(file, OIIO::geterror());
        const OIIO::ImageSpec& spec = input_->spec();
        if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || spec.deep) refuse_image(file, "it has no pixels in a plane");
        if (spec.height > max_image_pixels / spec.width || spec.nchannels > max_image_channels)
            refuse_image(file, "it has " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels and " + std::to_string(spec.nchannels) +
                                   " channels; at most 2^28 pixels and " + std::to_string(max_image_channels) + " channels can be read");
        check_memory(memory, file_bytes);
        fill_header();
    }

    std::span<const float> next_row() override
    {
        const auto row_samples = static_cast<std::size_t>(header_.width) * header_.channels.size();
        if (y_ == block_end_) {
            const int count = std::min(rows_at_once(), header_.height - y_);
            block_.resize(row_samples * static_cast<std::size_t>(count));
            if (!read_rows(y_, count, block_.data())) refuse_image(file_, input_->geterror());
            block_start_ = y_;
            block_end_ = y_ + count;
        }
        return std::span(block_).subspan(static_cast<std::size_t>(y_++ - block_start_) * row_samples, row_samples);
    }

private:
    // Of what OpenImageIO decodes as a whole though the format may not need it, and of rows of tiles.
    void check_memory(std::uint64_t memory, std::uint64_t file_bytes) const
    {
        constexpr std::array<std::string_view, 6> whole = {"targa", "psd", "dds", "ico", "iff", "softimage"};
        const OIIO::ImageSpec& spec = input_->spec();
        const auto width = static_cast<std::uint64_t>(spec.width), height = static_cast<std::uint64_t>(spec.height);
        if (std::find(whole.begin(), whole.end(), input_->format_name()) != whole.end())
            check_whole_image({width, height, spec.pixel_bytes(), true}, memory, file_bytes, file_);
        const std::uint64_t rows = spec.tile_width > 0 ? static_cast<std::uint64_t>(spec.tile_height) : 1;
        check_whole_image({width, rows, static_cast<std::uint64_t>(spec.nchannels) * sizeof(float), false}, memory, file_bytes, file_);
    }

    void fill_header()
    {
        const OIIO::ImageSpec& spec = input_->spec();
        header_.width = spec.width;
        header_.height = spec.height;
        header_.type = sample_type(spec.format);
        header_.channels = spec.channelnames;
        // The names that OpenImageIO gives to two channels which the format does not name are red and green.
        if (spec.nchannels == 2 && std::string_view(input_->format_name()) != "openexr") header_.channels = {"Y", "A"};
        header_.color_space = spec.get_string_attribute("oiio:ColorSpace");
        for (const auto& attribute : spec.extra_attribs) header_.attributes.emplace_back(attribute.name().string(), attribute.get_string());
    }

    int rows_at_once() const
    {
        const OIIO::ImageSpec& spec = input_->spec();
        if (spec.tile_width > 0) return std::max(1, spec.tile_height);
        const auto fit = block_samples / (static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels));
        return static_cast<int>(std::clamp<std::size_t>(fit, 1, 64));
    }

    bool read_rows(int y, int count, float* samples)
    {
        const OIIO::ImageSpec& spec = input_->spec();
        const int first = spec.y + y;
        if (spec.tile_width > 0)
            return input_->read_tiles(0, 0, spec.x, spec.x + spec.width, first, first + count, spec.z, spec.z + 1, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples);
        return input_->read_scanlines(0, 0, first, first + count, spec.z, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples);
    }

    std::filesystem::path file_;
    std::unique_ptr<OIIO::ImageInput> input_;
    std::vector<float> block_; // rows block_start_ to block_end_
    int block_start_ = 0;
    int block_end_ = 0;
    int y_ = 0; // of the next
};

std::string first_bytes(const std::filesystem::path& file)
{
    std::string bytes(std::size_t{1} << 16, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse_image(file, "it cannot be opened; check its permissions");
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return bytes;
}

bool is_exr(std::string_view start) { return start.starts_with("\x76\x2f\x31\x01"); }

bool is_webp(std::string_view start) { return start.starts_with("RIFF") && start.substr(0, 12).ends_with("WEBP"); }

std::unique_ptr<ImageFile> open_sniffed(const std::filesystem::path& file, std::uint64_t memory)
{
    const std::uint64_t size = std::filesystem::file_size(file);
    const std::string start = first_bytes(file);
    if (is_webp(start)) return open_webp(file, memory);
    check_whole_image(whole_image(start), memory, size, file);
    try {
        return std::make_unique<OpenImageIoFile>(file, memory, size);
    } catch (const FileError& error) {
        const bool subsampled = std::string_view(error.what()).find("Subsampled channels") != std::string_view::npos;
        if (!is_exr(start) || !subsampled) throw;
        return open_luminance_chroma(file);
    }
}

} // namespace

void refuse_image(const std::filesystem::path& file, std::string reason)
{
    while (!reason.empty() && reason.back() == '\n') reason.pop_back();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw FileError(file.string() + ": cannot read the image: " + reason);
}

std::unique_ptr<ImageFile> open_image(const std::filesystem::path& file, std::uint64_t memory)
{
    std::error_code error;
    if (!std::filesystem::exists(file, error)) throw FileError(file.string() + ": cannot read, there is no such file");
    if (std::filesystem::is_directory(file, error)) throw FileError(file.string() + ": cannot read, it is a folder; give an image file");
    if (const std::string fault = not_a_regular_file(file); !fault.empty()) refuse_image(file, "it " + fault);
    try {
        return open_sniffed(file, memory);
    } catch (const std::bad_alloc&) {
        refuse_image(file, "there is not enough memory for it");
    } catch (const std::length_error&) {
        refuse_image(file, "it claims more pixels than memory can hold");
    }
}

} // namespace sundog
