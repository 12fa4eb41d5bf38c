// The files of kernels/, embedded at build time (cmake/EmbedKernels.cmake writes the definitions).
#pragma once

#include <string_view>
#include <vector>

namespace sundog
{

// Text of the file at `path`, relative to kernels/ ("shared/vec3.h"); empty when there is no such file.
std::string_view kernel_source(std::string_view path);

// Paths of all embedded files, sorted.
std::vector<std::string_view> kernel_source_names();

} // namespace sundog
