// What lets one header serve C++ hosts and OpenCL C devices.
//
// Every header in this folder is a C subset: 4-byte scalars, packed triples, no
// float3 (whose size and alignment differ between host and device). Each struct
// states its size, and both compilers check it.
#ifndef SUNDOG_SHARED_PLATFORM_H
#define SUNDOG_SHARED_PLATFORM_H

#ifdef __OPENCL_C_VERSION__

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_SIZE(type, bytes) typedef char type##_size_check[(sizeof(type) == (bytes)) ? 1 : -1]
#define SHARED_CONSTANT __constant const

#else

#include <cstdint>

#define SHARED_BEGIN namespace sundog {
#define SHARED_END }
#define SHARED_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type " differs between host and device")
#define SHARED_CONSTANT inline constexpr

namespace sundog {
using uint = std::uint32_t;
using ulong = std::uint64_t;
} // namespace sundog

#endif
#endif
