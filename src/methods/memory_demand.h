// Parameters that ask for more than the device has.
#pragma once

#include "methods/method.h"

#include <cstddef>
#include <memory>

namespace sundog
{

// Creates the method. Throws DeviceError that names a value which the user set and which needs more memory than the device has.
std::unique_ptr<Method> create_method(const MethodInfo& info, RenderContext& context, const Parameters& parameters);

// Throws DeviceError where the parameter that the user set and that asks for most needs more than the memory. Pure, for tests.
void refuse_beyond_memory(const MethodInfo& info, const Parameters& parameters, double memory_bytes, std::size_t pixels);

} // namespace sundog
