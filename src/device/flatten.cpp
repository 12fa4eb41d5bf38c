#include "device/flatten.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

namespace sundog
{

namespace
{

// "word rest" of a preprocessor line, or empty words when it is none.
struct Directive {
    std::string_view word;
    std::string_view rest;
};

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

Directive parse_directive(std::string_view line)
{
    line = trimmed(line);
    if (!line.starts_with('#')) return {};
    line = trimmed(line.substr(1));
    const auto end = std::min(line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), line.size());
    return {line.substr(0, end), trimmed(line.substr(end))};
}

// Path of a quoted include; empty for others.
std::string_view included_path(const Directive& directive)
{
    if (directive.word != "include" || !directive.rest.starts_with('"')) return {};
    const auto end = directive.rest.find('"', 1);
    return end == std::string_view::npos ? std::string_view() : directive.rest.substr(1, end - 1);
}

class Flattener
{
public:
    explicit Flattener(const SourceLookup& lookup) : lookup_(lookup) {}

    void define(const std::string& name, const std::string& value) { output_ += fmt::format("#define {} {}\n", name, value); }

    void include(std::string_view path, bool conditional, const std::string& where)
    {
        if (done_.contains(path) || std::find(open_.begin(), open_.end(), path) != open_.end()) return;
        const std::string_view text = lookup_(path);
        if (text.empty()) throw std::logic_error(fmt::format("{}: there is no kernel source '{}'", where, path));
        if (!conditional) done_.emplace(path);
        append(path, text, conditional);
    }

    // conditional: the file stands inside #if of one that includes it.
    void append(std::string_view path, std::string_view text, bool conditional)
    {
        open_.push_back(path);
        mark_line(1, path);
        int depth = 0, guard_depth = 0, number = 0;
        bool first_directive = true;
        while (!text.empty()) {
            ++number;
            const auto end = std::min(text.find('\n'), text.size());
            const std::string_view line = text.substr(0, end);
            text.remove_prefix(std::min(end + 1, text.size()));

            const Directive directive = parse_directive(line);
            if (directive.word.starts_with("if")) {
                ++depth;
                if (first_directive && directive.word == "ifndef") guard_depth = 1;
            }
            if (directive.word == "endif") --depth;
            if (!directive.word.empty()) first_directive = false;

            if (const auto inner = included_path(directive); !inner.empty()) {
                include(inner, conditional || depth > guard_depth, fmt::format("{}:{}", path, number));
                mark_line(number + 1, path);
            } else {
                output_.append(line).push_back('\n');
            }
        }
        open_.pop_back();
    }

    std::string take() { return std::move(output_); }

private:
    void mark_line(int number, std::string_view path) { output_ += fmt::format("#line {} \"{}\"\n", number, path); }

    const SourceLookup& lookup_;
    std::string output_;
    std::set<std::string, std::less<>> done_;
    std::vector<std::string_view> open_; // files around the current line
};

} // namespace

std::string flatten_source(std::string_view path, std::string_view text, const BuildOptions& options, const SourceLookup& lookup)
{
    Flattener flattener(lookup);
    for (const auto& [name, value] : options.defines) flattener.define(name, value);
    for (const auto& header : options.prelude) flattener.include(header, false, fmt::format("prelude of {}", path));
    flattener.append(path, text, false);
    return flattener.take();
}

} // namespace sundog
