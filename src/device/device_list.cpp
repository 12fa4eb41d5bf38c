// Which devices there are, and which one a selector means.
#include "base/errors.h"
#include "base/log.h"
#include "device/device_state.h"
#include "device/environment.h"
#include "device/pocl_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace sundog
{

namespace
{

struct FoundDevice {
    DeviceInfo info;
    cl::Device device;
};

// A simulator (oclgrind) claims to be of every kind: then it is taken as a CPU.
void set_kind(DeviceInfo& info, cl_device_type type)
{
    info.is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    info.is_gpu = (type & CL_DEVICE_TYPE_GPU) != 0 && !info.is_cpu;
}

std::string without_padding(std::string text)
{
    while (!text.empty() && (text.back() == '\0' || std::isspace(static_cast<unsigned char>(text.back())))) text.pop_back();
    return text;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device)
{
    DeviceInfo info;
    info.name = without_padding(device.getInfo<CL_DEVICE_NAME>());
    info.platform = without_padding(platform.getInfo<CL_PLATFORM_NAME>() + " " + platform.getInfo<CL_PLATFORM_VERSION>());
    info.driver = without_padding(device.getInfo<CL_DRIVER_VERSION>());
    info.version = without_padding(device.getInfo<CL_DEVICE_VERSION>());
    set_kind(info, device.getInfo<CL_DEVICE_TYPE>());
    info.unified_memory = device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() != 0;
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    if (auto limit = environment_number("SUNDOG_MEMORY_LIMIT")) info.memory_bytes = std::min(info.memory_bytes, *limit << 20);
    info.largest_buffer_bytes = std::min<std::uint64_t>(device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(), info.memory_bytes);
    info.largest_work_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    const auto item_sizes = device.getInfo<CL_DEVICE_MAX_WORK_ITEM_SIZES>();
    if (!item_sizes.empty()) info.largest_work_group = std::min(info.largest_work_group, item_sizes.front());
    info.has_int64_atomics = device.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_int64_base_atomics") != std::string::npos;
    return info;
}

bool is_usable(const cl::Device& device)
{
    return device.getInfo<CL_DEVICE_AVAILABLE>() && device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>();
}

// Sorted by platform, so that the loader's order of directory entries does not matter.
std::vector<FoundDevice> find_devices()
{
    provide_pocl_cache();
    std::vector<cl::Platform> platforms;
    if (cl::Platform::get(&platforms) != CL_SUCCESS) return {};
    std::vector<FoundDevice> found;
    for (const auto& platform : platforms) {
        std::vector<cl::Device> devices;
        if (platform.getDevices(CL_DEVICE_TYPE_ALL, &devices) != CL_SUCCESS) continue;
        for (const auto& device : devices)
            if (is_usable(device)) found.push_back({describe(platform, device), device});
        if (platform.getInfo<CL_PLATFORM_NAME>().starts_with("Portable Computing Language"))
            if (const std::string warning = take_pocl_cache_warning(); !warning.empty()) log_warning(warning);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.info.platform < b.info.platform; });
    for (std::size_t i = 0; i < found.size(); ++i) found[i].info.index = int(i);
    return found;
}

std::string lower_case(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return lower;
}

bool is_index(std::string_view selector, int& index)
{
    const auto [end, error] = std::from_chars(selector.data(), selector.data() + selector.size(), index);
    return error == std::errc() && end == selector.data() + selector.size();
}

bool matches(const DeviceInfo& device, const std::string& selector)
{
    if (selector == "cpu") return device.is_cpu;
    if (selector == "gpu") return device.is_gpu;
    return lower_case(device.name).find(selector) != std::string::npos || lower_case(device.platform).find(selector) != std::string::npos;
}

std::string name_all(const std::vector<DeviceInfo>& devices)
{
    std::string names;
    for (const auto& device : devices)
        names += fmt::format("{}{} '{}'{}", names.empty() ? "" : ", ", device.index, device.name,
                             device.is_cpu   ? " (cpu)"
                             : device.is_gpu ? " (gpu)"
                                             : "");
    return names;
}

} // namespace

std::vector<DeviceInfo> list_devices()
{
    std::vector<DeviceInfo> devices;
    for (auto& found : find_devices()) devices.push_back(std::move(found.info));
    return devices;
}

DeviceInfo select_device(std::string_view selector)
{
    const auto devices = list_devices();
    if (devices.empty())
        throw DeviceError("no OpenCL device found: to render on the CPU, install the package pocl-opencl-icd; to render on a GPU, install "
                          "its driver's OpenCL package (nvidia-opencl-icd, intel-opencl-icd, mesa-opencl-icd)");
    const std::string wanted = lower_case(selector);
    if (wanted.empty()) {
        const auto gpu = std::find_if(devices.begin(), devices.end(), [](const auto& device) { return device.is_gpu; });
        return gpu != devices.end() ? *gpu : devices.front();
    }
    if (wanted == "all") {
        if (devices.size() == 1) return devices.front();
        throw DeviceError(fmt::format("Sundog renders on one device at a time so far; choose one of: {}", name_all(devices)));
    }
    int index = 0;
    if (is_index(wanted, index)) {
        if (index >= 0 && index < int(devices.size())) return devices[std::size_t(index)];
    } else {
        const auto found = std::find_if(devices.begin(), devices.end(), [&](const auto& device) { return matches(device, wanted); });
        if (found != devices.end()) return *found;
    }
    throw DeviceError(
        fmt::format("no OpenCL device matches '{}'; choose by index, part of a name, cpu or gpu among: {}", selector, name_all(devices)));
}

cl::Device find_opencl_device(const DeviceInfo& info)
{
    for (const auto& found : find_devices())
        if (found.info.index == info.index && found.info.name == info.name) return found.device;
    throw DeviceError(fmt::format("OpenCL device {} '{}' is gone; list the present ones with 'sundog devices'", info.index, info.name));
}

} // namespace sundog
