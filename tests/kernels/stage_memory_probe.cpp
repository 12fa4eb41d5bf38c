// A kernel with a fault, for the check under oclgrind to prove that it would see one (kernels/check_oclgrind.py).
#include "support/device_fixture.h"

namespace sundog
{
namespace
{

class MemoryProbe : public DeviceFixture
{
};

TEST_F(MemoryProbe, DISABLED_WritesBeyondItsBuffer)
{
    const Kernel kernel = test_kernel("__kernel void test(__global uint* numbers) { numbers[get_global_id(0)] = 1u; }");
    const auto numbers = allocate<uint>(10);
    kernel(16, numbers);
    device_.finish();
}

} // namespace
} // namespace sundog
