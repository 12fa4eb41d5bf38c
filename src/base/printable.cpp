#include "base/printable.h"

#include <cstdio>

namespace sundog
{

namespace
{

std::string escape(unsigned char c)
{
    if (c == '\n') return "\\n";
    if (c == '\r') return "\\r";
    if (c == '\t') return "\\t";
    char text[8];
    std::snprintf(text, sizeof text, "\\x%02x", c);
    return text;
}

std::string escaped(std::string_view text, std::string_view allowed)
{
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); i++) {
        const auto c = static_cast<unsigned char>(text[i]);
        // U+0080 to U+009F are C2 80 to C2 9F.
        const bool second_block = c == 0xc2 && i + 1 < text.size() && (static_cast<unsigned char>(text[i + 1]) & 0xe0) == 0x80;
        if (second_block)
            result += escape(static_cast<unsigned char>(text[++i]));
        else if ((c < 0x20 || c == 0x7f) && allowed.find(text[i]) == std::string_view::npos)
            result += escape(c);
        else
            result += text[i];
    }
    return result;
}

} // namespace

std::string printable(std::string_view text)
{
    return escaped(text, "");
}

std::string printable_lines(std::string_view text)
{
    return escaped(text, "\n\t");
}

} // namespace sundog
