// Outputs that would destroy an input, or each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sundog {

struct NamedFile {
    std::string name; // as the user knows it: "the scene", "--stats"
    std::filesystem::path path;
};

// Throws UsageError where an output is an input or another output, by whatever links or spellings.
void check_outputs_apart(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

} // namespace sundog
