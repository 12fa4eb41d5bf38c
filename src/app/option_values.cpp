#include "app/option_values.h"

#include "base/errors.h"

#include <charconv>
#include <cmath>

namespace sundog {

namespace {

template <class Number> bool parse_whole(std::string_view text, Number& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

} // namespace

std::map<std::string, std::string> parse_assignments(const std::string& option, const std::vector<std::string>& texts)
{
    std::map<std::string, std::string> values;
    for (const std::string& text : texts) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) throw UsageError(option + " needs NAME=VALUE, got \"" + text + "\"");
        values[text.substr(0, equals)] = text.substr(equals + 1);
    }
    return values;
}

std::pair<int, int> parse_size(const std::string& text)
{
    const auto cross = text.find('x');
    int width = 0, height = 0;
    const std::string_view view = text;
    if (cross == std::string::npos || !parse_whole(view.substr(0, cross), width) || !parse_whole(view.substr(cross + 1), height) || width < 1 || height < 1)
        throw UsageError("--size needs WIDTHxHEIGHT in pixels, such as 1280x720, got \"" + text + "\"");
    return {width, height};
}

std::uint64_t parse_count(const std::string& option, const std::string& text)
{
    std::uint64_t value = 0;
    if (!parse_whole(std::string_view(text), value)) throw UsageError(option + " needs a non-negative integer, got \"" + text + "\"");
    return value;
}

std::pair<std::string, std::string> parse_address(const std::string& option, const std::string& text)
{
    const auto colon = text.rfind(':');
    std::string host = text.substr(0, colon);
    const std::string port = colon == std::string::npos ? "" : text.substr(colon + 1);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    else if (host.find(':') != std::string::npos) host.clear(); // which colon starts the port?
    std::uint16_t number = 0;
    if (host.empty() || !parse_whole(std::string_view(port), number) || number == 0)
        throw UsageError(option + " needs HOST:PORT, such as localhost:14158, got \"" + text + "\"");
    return {host, std::to_string(number)};
}

std::uint64_t parse_megabytes(const std::string& option, const std::string& text)
{
    const std::uint64_t megabytes = parse_count(option, text);
    if (megabytes > 1'000'000'000) throw UsageError(option + " must be at most 1000000000 MB, got " + text);
    return megabytes * 1'000'000;
}

double parse_finite(const std::string& option, const std::string& text)
{
    double value = 0.0;
    if (!parse_whole(std::string_view(text), value) || !std::isfinite(value)) throw UsageError(option + " needs a number, got \"" + text + "\"");
    return value;
}

} // namespace sundog
