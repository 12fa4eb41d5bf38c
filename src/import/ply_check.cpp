#include "import/ply_check.h"

#include "import/ply_header.h"
#include "import/text_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace sundog
{

namespace
{

// Values in the order of the file, of which nothing is kept.
class PlyBody
{
public:
    PlyBody(const PlyHeader& header, std::string_view content, const SourceLocation& file)
        : format_(header.format), rest_(content.substr(header.size)), where_(file)
    {
        if (format_ == PlyFormat::text) where_.line = header.lines;
    }

    [[noreturn]] void fail(const std::string& message) const { throw SceneError(where_, message); }

    // In text files each element has a line.
    void begin_element()
    {
        if (format_ != PlyFormat::text) return;
        do {
            if (rest_.empty()) fail("the file ends early: is it truncated?");
            const std::size_t end = std::min(rest_.find('\n'), rest_.size());
            words_ = tokens(rest_.substr(0, end));
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            where_.line++;
        } while (words_.empty());
        next_word_ = 0;
    }

    void end_element() const
    {
        if (format_ == PlyFormat::text && next_word_ != words_.size()) fail("more values in the line than the header says");
    }

    double next(PlyType type)
    {
        if (format_ == PlyFormat::text) return next_text();
        const std::size_t size = size_of(type);
        if (rest_.size() < size) fail("the file ends early: is it truncated?");
        std::array<char, 8> bytes{};
        std::copy_n(rest_.begin(), size, bytes.begin());
        rest_.remove_prefix(size);
        const bool big = format_ == PlyFormat::big_endian;
        if (big != (std::endian::native == std::endian::big))
            std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        return decode(type, bytes.data());
    }

private:
    template <typename T> static double as(const char* bytes)
    {
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return static_cast<double>(value);
    }

    static double decode(PlyType type, const char* bytes)
    {
        switch (type) {
        case PlyType::int8:
            return as<std::int8_t>(bytes);
        case PlyType::uint8:
            return as<std::uint8_t>(bytes);
        case PlyType::int16:
            return as<std::int16_t>(bytes);
        case PlyType::uint16:
            return as<std::uint16_t>(bytes);
        case PlyType::int32:
            return as<std::int32_t>(bytes);
        case PlyType::uint32:
            return as<std::uint32_t>(bytes);
        case PlyType::float32:
            return as<float>(bytes);
        case PlyType::float64:
            break;
        }
        return as<double>(bytes);
    }

    double next_text()
    {
        if (next_word_ == words_.size()) fail("fewer values in the line than the header says");
        const std::string_view word = words_[next_word_++];
        const auto value = parse_number(word);
        if (!value) fail("'" + std::string(word) + "' is not a finite number");
        return *value;
    }

    PlyFormat format_;
    std::string_view rest_;
    SourceLocation where_;
    std::vector<std::string_view> words_; // of the line of the element
    std::size_t next_word_ = 0;
};

std::string element_name(const PlyElement& element, std::size_t i)
{
    return element.name + " " + std::to_string(i + 1);
}

void check_list(PlyBody& body, const PlyElement& element, std::size_t i, const PlyProperty& property, std::size_t vertices)
{
    const double count = body.next(*property.count_type);
    if (!(count >= 0.0) || count != std::floor(count))
        body.fail(element_name(element, i) + " has a list of " + std::to_string(count) + " values");
    const bool is_face = property.role == PlyRole::indices;
    if (is_face && count < 3.0) body.fail(element_name(element, i) + " has fewer than three vertices");
    for (double k = 0; k < count; k++) {
        const double index = body.next(property.type);
        if (is_face && !(index >= 0.0 && index < static_cast<double>(vertices)))
            body.fail(element_name(element, i) + " refers to vertex " + std::to_string(static_cast<long long>(index)) + ", but there are " +
                      std::to_string(vertices) + " (indices start at 0)");
    }
}

} // namespace

void check_ply(const std::filesystem::path& file, std::string_view content)
{
    const SourceLocation where{file.string(), 0};
    const PlyHeader header = read_ply_header(where, content);
    PlyBody body(header, content, where);
    for (const auto& element : header.elements) {
        for (std::size_t i = 0; i < element.count; i++) {
            body.begin_element();
            for (const auto& property : element.properties) {
                if (property.count_type) {
                    check_list(body, element, i, property, header.vertices);
                    continue;
                }
                const double value = body.next(property.type);
                if (property.role == PlyRole::coordinate && !std::isfinite(static_cast<float>(value)))
                    body.fail(element_name(element, i) + " is not finite: repair the mesh");
            }
            body.end_element();
        }
    }
}

} // namespace sundog
