// Built programs: shared within a device, and kept on disk between runs. For src/device alone.
#pragma once

#include "device/opencl.h"

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace sundog
{

// A built program, and where its binary belongs.
class Program
{
public:
    Program(cl::Program program, std::string cache_key, bool from_cache);

    const cl::Program& program() const { return program_; }

    // Writes the binary to the disk cache, unless it came from there. Call once the kernels have run: some
    // drivers generate code no earlier. Never throws.
    void store();

private:
    cl::Program program_;
    std::string cache_key_;
    bool stored_;
    std::mutex mutex_;
};

// The programs in use on one device, by source text. Thread-safe.
class ProgramShelf
{
public:
    // The program of this text: in use already, else from the disk cache, else built. `name` is for errors.
    // Throws DeviceError with the build log.
    std::shared_ptr<Program> get(Device::State& device, const std::string& name, const std::string& text);

private:
    std::mutex mutex_;
    std::unordered_map<std::string, std::weak_ptr<Program>> programs_; // by cache key
};

} // namespace sundog
