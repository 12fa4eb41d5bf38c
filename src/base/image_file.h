// Image files that are read: first what a file says of itself, then its rows, so that nobody holds more of them than they want.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sundog {

enum class SampleType { byte, integer, real };

struct ImageHeader {
    int width = 0;
    int height = 0;
    SampleType type = SampleType::byte; // of the channel with the widest one
    std::vector<std::string> channels; // as the file names them; "Y" and "A" for gray and alpha
    std::string color_space; // "sRGB", "Linear", ... where the file says it
    std::vector<std::pair<std::string, std::string>> attributes; // what else it says, as text
};

class ImageFile {
public:
    virtual ~ImageFile() = default;
    const ImageHeader& header() const { return header_; }
    // The samples of the next row from the top, pixel by pixel, each a float; integers are fractions of the largest. Colours are as
    // in the file: encoded, and not multiplied by alpha. At most header().height calls; valid until the next. Throws FileError.
    virtual std::span<const float> next_row() = 0;

protected:
    ImageHeader header_;
};

constexpr std::uint64_t least_decoding_memory = std::uint64_t{256} << 20;
constexpr long long max_image_pixels = 1LL << 28;
constexpr int max_image_channels = 64;

// Most formats are decoded a few rows at a time. Those that must be decoded as a whole are refused where that takes more than
// `memory` bytes (but never below least_decoding_memory). Throws FileError for what is not a regular file, not an image, has more
// than max_image_pixels, or claims more pixels than its length can hold. Knows no format in a minimal build.
std::unique_ptr<ImageFile> open_image(const std::filesystem::path& file, std::uint64_t memory);

} // namespace sundog
