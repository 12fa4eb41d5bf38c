# Writes kernel sources into one C++ file, so that the library needs no files at run time.
#
#   cmake -DOUTPUT=embedded.cpp -DROOT=kernels "-DFILES=shared/vec3.h;stages/trace.cl" -P EmbedKernels.cmake
#
# The result defines what src/device/kernel_sources.h declares.
cmake_minimum_required(VERSION 3.25)

# Some compilers refuse long string literals; adjacent ones are joined by the compiler.
set(longest_literal 14000)

list(SORT FILES)
set(entries "")
foreach(file IN LISTS FILES)
  file(READ "${ROOT}/${file}" content)
  string(LENGTH "${content}" length)
  set(literals "")
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${content}" ${begin} ${longest_literal} part)
    string(APPEND literals "R\"SUNDOG(${part})SUNDOG\"\n")
    math(EXPR begin "${begin} + ${longest_literal}")
  endwhile()
  if(length EQUAL 0)
    set(literals "\"\"\n")
  endif()
  string(APPEND entries "    {\"${file}\",\n${literals}    },\n")
endforeach()

file(WRITE "${OUTPUT}" "// Generated from kernels/ by cmake/EmbedKernels.cmake.
#include \"device/kernel_sources.h\"

#include <map>

namespace sundog {

namespace {

const std::map<std::string_view, std::string_view>& sources()
{
    static const std::map<std::string_view, std::string_view> map = {
${entries}    };
    return map;
}

} // namespace

std::string_view kernel_source(std::string_view path)
{
    auto found = sources().find(path);
    return found == sources().end() ? std::string_view() : found->second;
}

std::vector<std::string_view> kernel_source_names()
{
    std::vector<std::string_view> names;
    for (const auto& [path, source] : sources()) names.push_back(path);
    return names;
}

} // namespace sundog
")
