#include "methods/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace sundog {

namespace {

// 2^53: integers up to here are exact as doubles, which is how limits are stored.
constexpr double largest_exact = 9007199254740992.0;

std::string trim(const std::string& text)
{
    constexpr const char* space = " \t\r\n";
    const auto first = text.find_first_not_of(space);
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(space) - first + 1);
}

template <class Number> std::optional<Number> parse_number(std::string_view text)
{
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// Plain digits, or scientific notation of a whole number ("1e6").
std::optional<std::int64_t> parse_integer(const std::string& text)
{
    if (const auto plain = parse_number<std::int64_t>(text)) return plain;
    if (text.find_first_of("eE") == std::string::npos) return std::nullopt;
    const auto value = parse_number<double>(text);
    if (!value || std::abs(*value) > largest_exact || *value != std::floor(*value)) return std::nullopt;
    return static_cast<std::int64_t>(*value);
}

bool is_bounded(const ParameterSpec& spec) { return spec.minimum < spec.maximum; }

bool in_range(const ParameterSpec& spec, double value) { return !is_bounded(spec) || (value >= spec.minimum && value <= spec.maximum); }

std::string range_text(const ParameterSpec& spec)
{
    if (!is_bounded(spec)) return {};
    if (!std::isfinite(spec.maximum)) return fmt::format(" of at least {:g}", spec.minimum);
    return fmt::format(" from {:g} to {:g}", spec.minimum, spec.maximum);
}

std::string joined(const std::vector<std::string>& words)
{
    return fmt::format("{}", fmt::join(words, ", "));
}

// "an integer from 1 to 10".
std::string allowed(const ParameterSpec& spec)
{
    switch (spec.type) {
    case ParameterType::integer: return "an integer" + range_text(spec);
    case ParameterType::real: return "a number" + range_text(spec);
    case ParameterType::boolean: return "true or false";
    case ParameterType::choice: return "one of " + joined(spec.choices);
    case ParameterType::file: return "a file name";
    }
    return {};
}

// The canonical text of a value, so that 0.50 and 0.5 are one; nullopt when it does not fit the spec.
std::optional<std::string> canonical(const ParameterSpec& spec, const std::string& raw)
{
    const std::string text = trim(raw);
    switch (spec.type) {
    case ParameterType::integer:
        if (const auto value = parse_integer(text); value && in_range(spec, static_cast<double>(*value))) return std::to_string(*value);
        return std::nullopt;
    case ParameterType::real:
        if (const auto value = parse_number<double>(text); value && std::isfinite(*value) && in_range(spec, *value)) return fmt::format("{}", *value);
        return std::nullopt;
    case ParameterType::file: return text;
    case ParameterType::boolean:
        if (text == "true" || text == "false") return text;
        return std::nullopt;
    case ParameterType::choice:
        if (std::find(spec.choices.begin(), spec.choices.end(), text) != spec.choices.end()) return text;
        return std::nullopt;
    }
    return std::nullopt;
}

[[noreturn]] void refuse_at(const SourceLocation& where, const std::string& message)
{
    if (where.file.empty()) throw UsageError(message);
    throw SceneError(where, message);
}

} // namespace

Parameters::Parameters(const std::string& method, const std::vector<ParameterSpec>& specs, const std::map<std::string, ParameterValue>& values)
{
    for (const ParameterSpec& spec : specs) {
        const auto given = values.find(spec.name);
        set_[spec.name] = given != values.end() ? std::optional(given->second.where) : std::nullopt;
        const auto value = canonical(spec, given != values.end() ? given->second.text : spec.default_value);
        if (!value && given == values.end()) throw std::logic_error("default of " + method + "'s " + spec.name + " is not " + allowed(spec));
        if (!value)
            refuse_at(given->second.where, fmt::format("parameter {} of {} must be {}, got \"{}\"", spec.name, method, allowed(spec), given->second.text));
        values_.emplace_back(spec.name, *value);
    }
    for (const auto& [name, value] : values) {
        if (set_.contains(name)) continue;
        std::vector<std::string> known;
        for (const ParameterSpec& spec : specs) known.push_back(spec.name);
        refuse_at(value.where, fmt::format("{} has no parameter \"{}\"; it has {}", method, name, known.empty() ? "none" : joined(known)));
    }
}

const std::string& Parameters::text(const std::string& name) const
{
    const auto found = std::find_if(values_.begin(), values_.end(), [&](const auto& entry) { return entry.first == name; });
    if (found == values_.end()) throw std::logic_error("a method asks for a parameter that it does not declare: " + name);
    return found->second;
}

std::int64_t Parameters::integer(const std::string& name) const
{
    const auto value = parse_number<std::int64_t>(text(name));
    assert(value && "not declared as an integer");
    return value.value();
}

double Parameters::real(const std::string& name) const
{
    const auto value = parse_number<double>(text(name));
    assert(value && "not declared as a number");
    return value.value();
}

bool Parameters::boolean(const std::string& name) const
{
    const std::string& value = text(name);
    assert((value == "true" || value == "false") && "not declared as a boolean");
    return value == "true";
}

bool Parameters::has(const std::string& name) const
{
    return set_.contains(name);
}

bool Parameters::is_set(const std::string& name) const
{
    const auto found = set_.find(name);
    return found != set_.end() && found->second.has_value();
}

void Parameters::refuse(const std::string& name, const std::string& message) const
{
    refuse_at(set_.at(name).value_or(SourceLocation{}), message);
}

std::vector<std::pair<std::string, std::string>> Parameters::all() const { return values_; }

} // namespace sundog
