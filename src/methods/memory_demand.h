// Parameters that ask for more than the device has.
#pragma once

#include "methods/method.h"

#include <cstddef>
#include <memory>

namespace sundog
{

// Creates the method. A value that needs more memory than the device has is refused by name, where the user set one.
std::unique_ptr<Method> create_method(const MethodInfo& info, RenderContext& context, const Parameters& parameters);

// Throws, where it was set, for a parameter each of whose objects would have to be smaller than it is. Pure, for tests.
void refuse_beyond_memory(const MethodInfo& info, const Parameters& parameters, double memory_bytes, std::size_t pixels);

} // namespace sundog
