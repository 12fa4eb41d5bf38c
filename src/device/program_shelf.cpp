#include "device/program_shelf.h"

#include "base/errors.h"
#include "base/hash.h"
#include "base/log.h"
#include "device/binary_cache.h"
#include "device/device_state.h"
#include "device/pocl_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace sundog
{

namespace
{

constexpr const char* build_options = "-cl-std=CL1.2 -cl-kernel-arg-info";

std::string cache_key(const DeviceInfo& device, const std::string& text)
{
    Hash hash;
    hash.append_field(SUNDOG_VERSION).append_field(build_options).append_field(text);
    hash.append_field(device.name).append_field(device.driver).append_field(device.platform).append_field(device.version);
    return hash.hex();
}

// A program from a cached binary, or a null one when the driver does not take it.
cl::Program from_binary(Device::State& device, const std::string& key)
{
    const auto binary = load_cached_binary(key);
    if (!binary) return {};
    cl_int code = CL_SUCCESS;
    const cl::Program::Binaries binaries = {{binary->begin(), binary->end()}};
    std::vector<cl_int> status;
    cl::Program program(device.context, {device.device}, binaries, &status, &code);
    if (code == CL_SUCCESS) code = program.build({device.device}, build_options);
    if (code == CL_SUCCESS) return program;
    log_debug(fmt::format("the driver refuses cached program {}: {}", key, opencl_error_name(code)));
    remove_cached_binary(key);
    return {};
}

cl::Program from_source(Device::State& device, const std::string& name, const std::string& text)
{
    const std::string subject = fmt::format("program '{}'", name);
    cl_int code = CL_SUCCESS;
    cl::Program program(device.context, text, false, &code);
    check(code, "clCreateProgramWithSource", subject, device);
    code = program.build({device.device}, build_options);
    if (code == CL_SUCCESS) return program;
    const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device);
    throw DeviceError(fmt::format("clBuildProgram failed for {} on device '{}': {}{}; build log:\n{}", subject, device.info.name,
                                  opencl_error_name(code), device.info.is_cpu ? pocl_cache_problem() : "", log));
}

// Nothing built for so long: the kernels of a render have all run.
constexpr std::chrono::seconds idle_time(2);

void store(const Program& program)
{
    cl_int code = CL_SUCCESS;
    const auto binaries = program.program.getInfo<CL_PROGRAM_BINARIES>(&code);
    if (code != CL_SUCCESS || binaries.size() != 1 || binaries.front().empty()) {
        log_debug(fmt::format("the driver gives no program binary: {}", opencl_error_name(code)));
        return;
    }
    const auto& binary = binaries.front();
    store_cached_binary(program.cache_key, {reinterpret_cast<const char*>(binary.data()), binary.size()});
}

} // namespace

std::shared_ptr<Program> ProgramShelf::get(Device::State& device, const std::string& name, const std::string& text)
{
    std::lock_guard lock(mutex_);
    const std::string key = cache_key(device.info, text);
    if (auto shared = programs_[key].lock()) return shared;

    const auto begin = Clock::now();
    cl::Program program = from_binary(device, key);
    const bool cached = program() != nullptr;
    if (!cached) program = from_source(device, name, text);
    const std::chrono::duration<double> seconds = Clock::now() - begin;
    device.profile.add_program(seconds.count(), cached);
    log_debug(fmt::format("program '{}' {} in {:.3f} s", name, cached ? "loaded" : "built", seconds.count()));

    auto made = std::make_shared<Program>(Program{std::move(program), key, cached});
    programs_[key] = made;
    last_build_ = Clock::now();
    return made;
}

void ProgramShelf::generated_code(const std::shared_ptr<Program>& program)
{
    std::lock_guard lock(mutex_);
    last_build_ = Clock::now();
    if (program->from_cache) return;
    if (std::find(unstored_.begin(), unstored_.end(), program) == unstored_.end()) unstored_.push_back(program);
}

void ProgramShelf::store_when_idle()
{
    std::lock_guard lock(mutex_);
    if (unstored_.empty() || Clock::now() - last_build_ < idle_time) return;
    store(*unstored_.back());
    unstored_.pop_back();
}

void ProgramShelf::store_all()
{
    std::lock_guard lock(mutex_);
    for (const auto& program : unstored_) store(*program);
    unstored_.clear();
}

} // namespace sundog
