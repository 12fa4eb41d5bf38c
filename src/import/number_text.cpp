#include "import/number_text.h"

#include "import/text_file.h"

#include <charconv>

namespace sundog
{

namespace
{

template <class T> std::string shortest(T value)
{
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

} // namespace

std::string number_text(double value)
{
    return shortest(value);
}

std::string rounded_text(double value)
{
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 3);
    return {buffer, end};
}

std::string number_text(float value)
{
    // Rounded twice, from the text to a double to a float, a text that is close to the middle of two floats may end on
    // the wrong one.
    const std::string text = shortest(value);
    const auto read = parse_number(text);
    return read && static_cast<float>(*read) == value ? text : shortest(static_cast<double>(value));
}

} // namespace sundog
