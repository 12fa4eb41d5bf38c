// One program text from many files: OpenCL drivers differ in how they find headers, so they are given none to find.
#pragma once

#include "device/kernel.h"

#include <functional>
#include <string>
#include <string_view>

namespace sundog
{

// Text of a file by its path; empty when there is none.
using SourceLookup = std::function<std::string_view(std::string_view path)>;

// The defines, the prelude's files and `text` (whose name is `path`), with every #include "..." replaced by the
// file's text once per program, and #line directives so that build logs name file and line. An include inside
// #if ... #endif is replaced wherever it stands, since only the compiler knows the condition; header guards then
// keep it single. Throws std::logic_error naming file and line where a file does not exist.
std::string flatten_source(std::string_view path, std::string_view text, const BuildOptions& options, const SourceLookup& lookup);

} // namespace sundog
