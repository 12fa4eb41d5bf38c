#include "import/text_file.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

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

} // namespace

std::string read_text_file(const std::filesystem::path& file, const SourceLocation& wanted_at)
{
    std::error_code failed;
    const auto status = std::filesystem::status(file, failed);
    if (!std::filesystem::exists(status)) throw SceneError(wanted_at, "file '" + file.string() + "' not found");
    if (std::filesystem::is_directory(status)) throw SceneError(wanted_at, "'" + file.string() + "' is a folder, not a file");
    std::ifstream stream(file, std::ios::binary);
    std::string content;
    if (std::filesystem::is_regular_file(status)) {
        // In one piece: a stream's buffer would grow in steps and take twice the room.
        const std::uintmax_t size = std::filesystem::file_size(file, failed);
        content.resize(failed ? 0 : static_cast<std::size_t>(size));
        stream.read(content.data(), static_cast<std::streamsize>(content.size()));
        content.resize(static_cast<std::size_t>(stream.gcount()));
    } else if (stream.peek() != std::ifstream::traits_type::eof()) {
        std::ostringstream pieces;
        pieces << stream.rdbuf();
        content = std::move(pieces).str();
    }
    if (!stream.is_open() || stream.bad() || failed)
        throw SceneError(wanted_at, "file '" + file.string() + "' cannot be read: check its permissions");
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
