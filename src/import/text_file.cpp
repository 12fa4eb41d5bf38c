#include "import/text_file.h"

#include "base/regular_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>

namespace sundog
{

namespace
{

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
    // from_chars knows no plus sign.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
}

constexpr std::uintmax_t gibibyte = std::uintmax_t{1} << 30;
constexpr std::uintmax_t largest_file = 16 * gibibyte; // a mesh of 2^30 triangles
constexpr std::uintmax_t largest_stream = gibibyte;

[[noreturn]] void refuse_size(const std::filesystem::path& file, const SourceLocation& wanted_at, std::uintmax_t most)
{
    throw SceneError(wanted_at,
                     "'" + file.string() + "' is larger than " + std::to_string(most / gibibyte) + " GiB, the most that is read");
}

// In one piece: a stream's buffer would grow in steps and take twice the room.
std::string read_whole(std::istream& stream, std::uintmax_t size)
{
    std::string content(static_cast<std::size_t>(size), '\0');
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
    content.resize(static_cast<std::size_t>(stream.gcount()));
    return content;
}

// Stops soon after the most that is read.
std::string read_to_end(std::istream& stream)
{
    std::string content;
    std::array<char, 65536> piece;
    do {
        stream.read(piece.data(), piece.size());
        content.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    } while (stream.good() && content.size() <= largest_stream);
    return content;
}

} // namespace

std::string read_text_file(const std::filesystem::path& file, const SourceLocation& wanted_at, FileKind kind)
{
    if (kind == FileKind::regular_or_standard_input && file == "-") {
        std::string content = read_to_end(std::cin);
        if (content.size() > largest_stream) refuse_size(file, wanted_at, largest_stream);
        return content;
    }
    if (const std::string fault = not_a_regular_file(file); !fault.empty()) {
        const bool redirect = kind == FileKind::regular_or_standard_input && fault.starts_with("is a device");
        throw SceneError(wanted_at, (fault == "not found" ? "file '" : "'") + file.string() + "' " + fault +
                                        (redirect ? "; a scene from a pipe is named - and redirected with <" : ""));
    }
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(file, failed);
    if (!failed && size > largest_file) refuse_size(file, wanted_at, largest_file);
    std::ifstream stream(file, std::ios::binary);
    const bool open = stream.is_open();
    std::string content = open && !failed ? read_whole(stream, size) : std::string();
    if (!open || stream.bad() || failed) throw SceneError(wanted_at, "file '" + file.string() + "' cannot be read: check its permissions");
    return content;
}

std::optional<double> parse_number(std::string_view text)
{
    text = trimmed(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

bool is_not_finite(std::string_view text)
{
    text = trimmed(text);
    if (text.starts_with('-')) text.remove_prefix(1);
    if (text.starts_with("1.#")) return true; // Microsoft's
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) return end == text.data() + text.size();
    const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
    return error == std::errc() && !std::isfinite(value) && (rest.empty() || rest.starts_with('('));
}

std::string_view without_byte_order_mark(std::string_view text, const SourceLocation& where)
{
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") || text.starts_with(std::string_view("\0\0\xfe\xff", 4)))
        throw SceneError(where, "the file is UTF-16 or UTF-32 text: save it as UTF-8");
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text;
}

std::optional<long long> parse_integer(std::string_view text)
{
    text = trimmed(text);
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

std::vector<std::string_view> tokens(std::string_view text)
{
    std::vector<std::string_view> list;
    split(text, list);
    return list;
}

void split(std::string_view text, std::vector<std::string_view>& list)
{
    constexpr std::string_view separators = " \t\r\n,";
    list.clear();
    for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
        list.push_back(text.substr(begin, end - begin));
        begin = end;
    }
}

} // namespace sundog
