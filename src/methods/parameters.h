// A method's parameters: declared with type, default, unit and source; parsed from text; checked.
#pragma once

#include "base/errors.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sundog {

enum class ParameterType { integer, real, boolean, choice, file };

// One parameter as `sundog methods NAME` prints it.
struct ParameterSpec {
    std::string name; // snake_case
    ParameterType type = ParameterType::real;
    std::string default_value;
    std::string unit; // "" when it has none
    std::string description; // one sentence, with its source
    double minimum = 0.0; // inclusive, numbers only
    double maximum = 0.0;
    std::vector<std::string> choices; // choice only
    double device_bytes = 0.0; // integers only: that each of so many takes at least, or of so many a pixel
    bool is_per_pixel = false;
};

// Who set a value: wrong values are usage errors on the command line, scene errors in a file.
struct ParameterValue {
    std::string text;
    SourceLocation where; // empty file: the command line
};

// Values of one method's parameters, validated against its specs at construction.
// Unknown names, wrong types and values out of range throw UsageError or SceneError, naming the
// parameter, the value, what is allowed, and, for an unknown name, the known ones.
class Parameters {
public:
    Parameters() = default;
    Parameters(const std::string& method, const std::vector<ParameterSpec>& specs, const std::map<std::string, ParameterValue>& values);

    std::int64_t integer(const std::string& name) const;
    double real(const std::string& name) const;
    bool boolean(const std::string& name) const;
    const std::string& text(const std::string& name) const;
    bool has(const std::string& name) const; // whether the method has a parameter of this name
    bool is_set(const std::string& name) const; // by the user, rather than by default

    // Throws what a wrong value of this parameter throws, where it was set: for values that do not go together.
    [[noreturn]] void refuse(const std::string& name, const std::string& message) const;

    // Every parameter with the value in force, in the order of the specs.
    std::vector<std::pair<std::string, std::string>> all() const;

private:
    std::vector<std::pair<std::string, std::string>> values_;
    std::map<std::string, std::optional<SourceLocation>> set_; // where the user set it, if so
};

} // namespace sundog
