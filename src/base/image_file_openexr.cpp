// OpenEXR files of luminance and chroma (channels Y, RY and BY, the last two at half the resolution), by OpenEXR itself, which
// filters the chroma up.
#include "base/errors.h"
#include "base/image_decoders.h"

#include <ImfRgbaFile.h>

#include <exception>

namespace sundog {

namespace {

class LuminanceChromaFile : public ImageFile {
public:
    explicit LuminanceChromaFile(const std::filesystem::path& file) : file_(file), input_(file.c_str())
    {
        constexpr int wanted = Imf::WRITE_Y | Imf::WRITE_C;
        if ((input_.channels() & wanted) != wanted) refuse_image(file, "it has subsampled channels other than RY and BY of luminance and chroma");
        const Imath::Box2i& window = input_.dataWindow();
        const long long width = static_cast<long long>(window.max.x) - window.min.x + 1, height = static_cast<long long>(window.max.y) - window.min.y + 1;
        if (width < 1 || height < 1 || height > max_image_pixels / width) refuse_image(file, "it has no pixels, or more than 2^28");
        header_.width = static_cast<int>(width);
        header_.height = static_cast<int>(height);
        header_.type = SampleType::real;
        header_.channels = {"R", "G", "B", "A"};
        pixels_.resize(static_cast<std::size_t>(width));
        y_ = window.min.y;
    }

    std::span<const float> next_row() override
    {
        // The library adds x and y times the strides to the address that it is given.
        input_.setFrameBuffer(pixels_.data() - input_.dataWindow().min.x, 1, 0);
        try {
            input_.readPixels(y_++);
        } catch (const std::exception& error) {
            refuse_image(file_, error.what());
        }
        row_.clear();
        for (const Imf::Rgba& pixel : pixels_) row_.insert(row_.end(), {pixel.r, pixel.g, pixel.b, pixel.a});
        return row_;
    }

private:
    std::filesystem::path file_;
    Imf::RgbaInputFile input_;
    std::vector<Imf::Rgba> pixels_;
    std::vector<float> row_;
    int y_ = 0;
};

} // namespace

std::unique_ptr<ImageFile> open_luminance_chroma(const std::filesystem::path& file)
{
    try {
        return std::make_unique<LuminanceChromaFile>(file);
    } catch (const FileError&) {
        throw;
    } catch (const std::exception& error) {
        refuse_image(file, error.what());
    }
}

} // namespace sundog
