// Where the sources and the executable are. Only places.cpp knows, so that a compiler cache serves every checkout.
#pragma once

#include <filesystem>

namespace sundog::test {

std::filesystem::path source_folder();
std::filesystem::path sundog_executable();

} // namespace sundog::test
