#include "import/xml_encoding.h"

#include <algorithm>
#include <cctype>
#include <iconv.h>
#include <memory>
#include <string_view>

namespace sundog
{

namespace
{

using std::string_view_literals::operator""sv;

struct Signature {
    std::string_view bytes;
    const char* encoding;
};

// Byte order marks, the longer ones first, and "<" without one.
constexpr Signature signatures[] = {
    {"\xff\xfe\0\0"sv, "UTF-32LE"}, {"\0\0\xfe\xff"sv, "UTF-32BE"}, {"<\0\0\0"sv, "UTF-32LE"}, {"\0\0\0<"sv, "UTF-32BE"},
    {"\xff\xfe"sv, "UTF-16LE"},     {"\xfe\xff"sv, "UTF-16BE"},     {"<\0"sv, "UTF-16LE"},     {"\0<"sv, "UTF-16BE"},
};

// The encoding that the declaration names; "" without one.
std::string declared_encoding(std::string_view text)
{
    if (text.starts_with("\xef\xbb\xbf")) return {}; // UTF-8, whatever it declares
    if (!text.starts_with("<?xml")) return {};
    const std::string_view declaration = text.substr(0, text.find("?>"));
    const std::size_t name = declaration.find("encoding");
    const std::size_t open = name == std::string_view::npos ? name : declaration.find_first_of("\"'", name);
    if (open == std::string_view::npos) return {};
    const std::size_t close = declaration.find(declaration[open], open + 1);
    return close == std::string_view::npos ? std::string() : std::string(declaration.substr(open + 1, close - open - 1));
}

bool is_utf8(std::string encoding)
{
    std::transform(encoding.begin(), encoding.end(), encoding.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return encoding.empty() || encoding == "UTF-8" || encoding == "UTF8" || encoding == "US-ASCII" || encoding == "ASCII" ||
           encoding.starts_with("UTF-16") || encoding.starts_with("UTF-32"); // what says so in single bytes is mistaken
}

// Letters, digits, and the marks that names of encodings have; iconv reads options behind a slash.
bool is_encoding_name(std::string_view name)
{
    return name.size() < 64 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
               return c < 0x80 && (std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == ':');
           });
}

std::string converted(std::string_view text, const std::string& encoding, const SourceLocation& where)
{
    const iconv_t converter = is_encoding_name(encoding) ? iconv_open("UTF-8", encoding.c_str()) : iconv_t(-1);
    if (converter == iconv_t(-1))
        throw SceneError(where, "the file is in the encoding '" + encoding + "', which is not known here: convert it to UTF-8");
    const std::unique_ptr<void, int (*)(iconv_t)> closes(converter, iconv_close);
    std::string result;
    std::string source(text); // iconv takes it as not const
    char* in = source.data();
    std::size_t left = source.size();
    while (left > 0) {
        char piece[65536];
        char* out = piece;
        std::size_t room = sizeof piece;
        const bool whole = iconv(converter, &in, &left, &out, &room) != std::size_t(-1);
        result.append(piece, out);
        if (!whole && out == piece)
            throw SceneError(where, "the file is not in the encoding '" + encoding + "' from byte " + std::to_string(text.size() - left) +
                                        " on: convert it to UTF-8");
    }
    return result;
}

} // namespace

std::string utf8_of_xml(std::string text, const SourceLocation& where)
{
    const auto* const signature =
        std::find_if(std::begin(signatures), std::end(signatures), [&](const Signature& s) { return text.starts_with(s.bytes); });
    const std::string encoding = signature != std::end(signatures) ? signature->encoding : declared_encoding(text);
    return is_utf8(encoding) && signature == std::end(signatures) ? text : converted(text, encoding, where);
}

} // namespace sundog
