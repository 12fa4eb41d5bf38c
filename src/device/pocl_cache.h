// PoCL, which runs kernels on CPUs, writes every program it builds into a folder of its own, and builds none where it cannot.
#pragma once

#include <string>

namespace sundog
{

// Before the first OpenCL call. Where PoCL cannot write its folder ($POCL_CACHE_DIR, else one below $XDG_CACHE_HOME or ~/.cache), it
// gets a temporary one, which goes with this process.
void provide_pocl_cache();

// A warning for users of PoCL where its folder had to be another; else empty. Given once.
std::string take_pocl_cache_warning();

// For errors of PoCL's compiler: why its folder cannot be written now, and what to do; else empty.
std::string pocl_cache_problem();

// Why files cannot be written into the folder, which is made if need be; empty where they can.
std::string writing_problem(const std::string& folder);

} // namespace sundog
