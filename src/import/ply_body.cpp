#include "import/ply_body.h"

#include "import/text_file.h"

#include <cmath>
#include <limits>

namespace sundog
{

PlyBody::PlyBody(const PlyHeader& header, std::string_view content, const SourceLocation& file)
    : format_(header.format), swap_((header.format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)),
      rest_(content.substr(header.size)), where_(file)
{
    if (format_ == PlyFormat::text) where_.line = header.lines;
}

void PlyBody::begin_elements(const PlyElement& element) const
{
    std::size_t smallest = 0; // bytes
    for (const auto& property : element.properties)
        smallest += format_ == PlyFormat::text ? 2 : size_of(property.count_type.value_or(property.type));
    // The last line of a text file may lack its end.
    const std::size_t available = rest_.size() + (format_ == PlyFormat::text ? 1 : 0);
    if (element.count > available / smallest) {
        if (rest_.empty()) fail_early();
        fail("the file is too short for the " + std::to_string(element.count) + " elements '" + element.name +
             "' of its header: the file ends early, is it truncated?");
    }
}

void PlyBody::begin_element()
{
    if (format_ != PlyFormat::text) return;
    do {
        if (rest_.empty()) fail_early();
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        split(rest_.substr(0, end), words_);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        where_.line++;
    } while (words_.empty());
    next_word_ = 0;
}

void PlyBody::end_element() const
{
    if (format_ == PlyFormat::text && next_word_ != words_.size()) fail("more values in the line than the header says");
}

std::size_t PlyBody::next_count(const PlyProperty& list, const PlyElement& element, std::size_t i)
{
    const double count = next(*list.count_type);
    if (!(count >= 0.0) || count != std::floor(count))
        fail(element_name(element, i) + " has a list of " + std::to_string(count) + " values");
    const std::size_t available = format_ == PlyFormat::text ? words_.size() - next_word_ : rest_.size() / size_of(list.type);
    if (count > static_cast<double>(available)) {
        if (format_ == PlyFormat::text) fail("fewer values in the line than the header says");
        fail_early();
    }
    return static_cast<std::size_t>(count);
}

void PlyBody::skip(const PlyElement& element)
{
    begin_elements(element);
    for (std::size_t i = 0; i < element.count; i++) {
        begin_element();
        for (const auto& property : element.properties) {
            const std::size_t count = property.count_type ? next_count(property, element, i) : 1;
            for (std::size_t k = 0; k < count; k++) next(property.type);
        }
        end_element();
    }
}

double PlyBody::next_text()
{
    if (next_word_ == words_.size()) fail("fewer values in the line than the header says");
    const std::string_view word = words_[next_word_++];
    const auto value = parse_number(word);
    if (!value && is_not_finite(word)) return std::numeric_limits<double>::quiet_NaN();
    if (!value) fail("'" + std::string(word) + "' is not a number");
    return *value;
}

std::string element_name(const PlyElement& element, std::size_t i)
{
    return element.name + " " + std::to_string(i + 1);
}

} // namespace sundog
