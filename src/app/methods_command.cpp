// sundog methods [NAME]
#include "app/commands.h"
#include "methods/method.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>

namespace sundog {

namespace {

constexpr std::size_t line_width = 100;

// Words of the text in lines of at most `line_width`, each after `indent` spaces.
std::string wrapped(const std::string& text, std::size_t indent)
{
    std::istringstream words(text);
    std::string out, line;
    for (std::string word; words >> word;) {
        if (!line.empty() && indent + line.size() + 1 + word.size() > line_width) {
            out += std::string(indent, ' ') + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return out + std::string(indent, ' ') + line + "\n";
}

std::string allowed_values(const ParameterSpec& spec)
{
    switch (spec.type) {
    case ParameterType::boolean: return "true or false";
    case ParameterType::file: return "file name";
    case ParameterType::choice: return fmt::format("{}", fmt::join(spec.choices, ", "));
    case ParameterType::integer:
    case ParameterType::real: break;
    }
    std::string kind = spec.type == ParameterType::integer ? "integer" : "number";
    if (!(spec.minimum < spec.maximum)) return kind;
    if (spec.maximum >= 1e15) return fmt::format("{}, at least {:g}", kind, spec.minimum);
    return fmt::format("{}, {:g} to {:g}", kind, spec.minimum, spec.maximum);
}

std::string known_errors(const MethodInfo& method)
{
    if (method.error_model == ErrorModel::none) return "not estimated";
    const char* known = method.error_model == ErrorModel::variance ? "variance" : "bias and variance";
    std::string condition;
    for (const auto& [name, value] : method.errors_need) condition += (condition.empty() ? " with " : " and ") + name + "=" + value;
    return fmt::format("estimates its {}{} (--errors, --target-error)", known, condition);
}

void print_table()
{
    std::size_t width = 4;
    for (const MethodInfo* method : all_methods()) width = std::max(width, method->name.size());
    for (const MethodInfo* method : all_methods())
        std::cout << fmt::format("{:<{}}  {:<10}  {} ({})\n", method->name, width, method->estimator_class, method->title, method->paper);
    std::cout << "\nsundog methods NAME prints a method's parameters.\n";
}

void print_method(const MethodInfo& method)
{
    std::cout << method.name << ": " << method.title << "\n";
    std::cout << "paper: " << method.paper << "\n";
    std::cout << "estimator: " << method.estimator_class << "\nerrors: " << known_errors(method) << "\n\n"
              << wrapped(method.description, 0);
    std::cout << "\nparameters (-p NAME=VALUE, or in the scene's <integrator>):\n";
    for (const ParameterSpec& spec : method.parameters) {
        const std::string unit = spec.unit.empty() ? "" : ", " + spec.unit;
        std::cout << fmt::format("  {} = {}  [{}{}]\n", spec.name, spec.default_value, allowed_values(spec), unit) << wrapped(spec.description, 6);
    }
}

ExitStatus methods(const std::string& name)
{
    if (name.empty()) {
        print_table();
        return ExitStatus::done;
    }
    const MethodInfo* method = find_method(name);
    if (!method) throw UsageError("unknown method \"" + name + "\"; sundog methods lists them");
    print_method(*method);
    return ExitStatus::done;
}

} // namespace

void add_methods_command(CLI::App& app, ExitStatus& status)
{
    auto name = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("methods", "List the methods, or one method's parameters, defaults, units and paper");
    command->add_option("NAME", *name, "Method");
    command->callback([name, &status] { status = methods(*name); });
}

} // namespace sundog
