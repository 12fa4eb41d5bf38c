// The OpenCL headers, and how a failed call becomes a DeviceError. For src/device alone.
#pragma once

#include "device/device.h"

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <string>
#include <string_view>

namespace sundog
{

// "CL_OUT_OF_RESOURCES (-5)".
std::string opencl_error_name(cl_int code);

// True for the codes by which drivers report that memory ran out.
bool is_out_of_memory(cl_int code);

// Throws DeviceError: the call, what it was for (a kernel or a buffer, with its label), the device, the
// error's name and number, and what memory is in use where memory may be the cause.
[[noreturn]] void throw_opencl_error(cl_int code, std::string_view call, std::string_view subject, const Device::State& state);

inline void check(cl_int code, std::string_view call, std::string_view subject, const Device::State& state)
{
    if (code != CL_SUCCESS) throw_opencl_error(code, call, subject, state);
}

} // namespace sundog
