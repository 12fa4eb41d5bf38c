// Finding devices, choosing one, and what is said when there is none.
#include "base/errors.h"
#include "child_process.h"
#include "device/device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

namespace sundog
{
namespace
{

using testing::HasSubstr;

std::string selection_error(const std::string& selector)
{
    try {
        select_device(selector);
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "no DeviceError";
}

TEST(DeviceSelection, ListsDevicesInAStableOrder)
{
    const auto first = list_devices(), second = list_devices();
    ASSERT_FALSE(first.empty());
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].index, int(i));
        EXPECT_EQ(first[i].name, second[i].name);
        EXPECT_FALSE(first[i].name.empty());
        EXPECT_GT(first[i].compute_units, 0u);
        EXPECT_GT(first[i].memory_bytes, std::uint64_t(1) << 20);
        EXPECT_LE(first[i].largest_buffer_bytes, first[i].memory_bytes);
        EXPECT_GE(first[i].largest_work_group, 1u);
        EXPECT_FALSE(first[i].is_cpu && first[i].is_gpu);
    }
}

TEST(DeviceSelection, ChoosesByIndexKindAndPartOfAName)
{
    const auto devices = list_devices();
    for (const auto& device : devices) EXPECT_EQ(select_device(std::to_string(device.index)).index, device.index);

    const auto gpu = std::find_if(devices.begin(), devices.end(), [](const auto& d) { return d.is_gpu; });
    EXPECT_EQ(select_device("").index, gpu == devices.end() ? 0 : gpu->index);
    const auto cpu = std::find_if(devices.begin(), devices.end(), [](const auto& d) { return d.is_cpu; });
    if (cpu != devices.end()) {
        EXPECT_EQ(select_device("CPU").index, cpu->index);
    }

    std::string part = devices.front().name.substr(devices.front().name.size() / 3);
    std::transform(part.begin(), part.end(), part.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    EXPECT_EQ(select_device(part).index, 0);
}

TEST(DeviceSelection, NamesWhatThereIsWhenNothingMatches)
{
    const auto devices = list_devices();
    EXPECT_THAT(selection_error("no such device"), testing::AllOf(HasSubstr("no such device"), HasSubstr(devices.front().name)));
    EXPECT_THAT(selection_error("4711"), testing::AllOf(HasSubstr("4711"), HasSubstr(devices.front().name)));
    EXPECT_THAT(selection_error("-1"), HasSubstr("-1"));
    if (devices.size() == 1) {
        EXPECT_EQ(select_device("all").index, 0);
    } else {
        EXPECT_THAT(selection_error("all"), HasSubstr("one device at a time"));
    }
    if (std::none_of(devices.begin(), devices.end(), [](const auto& d) { return d.is_gpu; })) {
        EXPECT_THAT(selection_error("gpu"), HasSubstr("gpu"));
    }
}

TEST(DeviceSelection, OpensADeviceMoreThanOnce)
{
    Device first(select_device("")), second(select_device(""));
    first.set_work_group_size(8);
    EXPECT_EQ(first.work_group_size(), 8u);
    EXPECT_NE(second.work_group_size(), 8u);
    first.set_work_group_size(std::size_t(1) << 40);
    EXPECT_EQ(first.work_group_size(), first.info().largest_work_group);
}

TEST(DeviceSelection, RefusesADeviceThatIsGone)
{
    DeviceInfo info = select_device("");
    info.index = 4711;
    EXPECT_THROW(Device{info}, DeviceError);
}

TEST(DeviceSelectionChild, DISABLED_SaysWhatIsWrong)
{
    try {
        Device device(select_device(""));
        std::cout << "group size " << device.work_group_size() << ", memory " << device.info().memory_bytes << "\n";
    } catch (const DeviceError& error) {
        std::cout << "DeviceError: " << error.what() << "\n";
    }
}

TEST(DeviceSelection, NamesThePackagesWhenThereIsNoPlatform)
{
    const TemporaryFolder empty;
    const auto child = run_child("OCL_ICD_VENDORS=" + empty.string() + "/", "DeviceSelectionChild.DISABLED_SaysWhatIsWrong");
    EXPECT_EQ(child.status, 0) << child.output;
    EXPECT_THAT(child.output, testing::AllOf(HasSubstr("DeviceError: no OpenCL device found"), HasSubstr("pocl-opencl-icd")));
}

TEST(DeviceSelection, TakesLimitsFromTheEnvironment)
{
    const std::string test = "DeviceSelectionChild.DISABLED_SaysWhatIsWrong";
    EXPECT_THAT(run_child("SUNDOG_WORK_GROUP_SIZE=32 SUNDOG_MEMORY_LIMIT=100", test).output, HasSubstr("group size 32, memory 104857600"));
    EXPECT_THAT(run_child("SUNDOG_WORK_GROUP_SIZE=many", test).output, testing::AllOf(HasSubstr("DeviceError"), HasSubstr("'many'")));
    EXPECT_THAT(run_child("SUNDOG_MEMORY_LIMIT=0", test).output,
                testing::AllOf(HasSubstr("DeviceError"), HasSubstr("SUNDOG_MEMORY_LIMIT")));
}

} // namespace
} // namespace sundog
