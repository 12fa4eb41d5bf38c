// What tests of kernels share: a device, and kernels written in the test that include the real headers.
#pragma once

#include "device/kernel.h"
#include "shared/vec3.h"

#include <gtest/gtest.h>

#include <string>

namespace sundog
{

// Independent random numbers for the kernels of tests: random_words(i, salt), and as random4(i, salt) in [0, 1)^4.
inline const std::string random_source = R"(
#include "math/hash.h"
#include "math/philox.h"
inline uint4 random_words(uint i, uint salt) { return philox4x32((uint4)(i, salt, 0u, 0u), (uint2)(0x9d2c5680u, 0xefc60000u)); }
inline float4 random4(uint i, uint salt) { return unit_float4(random_words(i, salt)); }
)";

class DeviceFixture : public testing::Test
{
protected:
    // Builds kernel `test` of a program text that may include what is in kernels/.
    Kernel test_kernel(const std::string& source, const BuildOptions& options = {})
    {
        return Kernel::from_source(device_, "test", "Test", random_source + source, options);
    }

    template <class T> Buffer<T> upload(const std::vector<T>& data) { return Buffer<T>(device_, data, "test data"); }
    template <class T> Buffer<T> allocate(std::size_t count) { return Buffer<T>(device_, count, "test data"); }

    Device device_{select_device("")};
};

} // namespace sundog
