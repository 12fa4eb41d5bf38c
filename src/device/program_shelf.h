// Built programs: shared within a device, and kept on disk between runs. For src/device alone.
#pragma once

#include "device/opencl.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace sundog
{

// A built program, and where its binary belongs.
struct Program {
    cl::Program program;
    std::string cache_key;
    bool from_cache = false;
};

// The programs of one device, by source text. Thread-safe.
//
// They stay for as long as the device: the next session on it needs most of them again, and to load one takes 10 ms.
//
// Binaries are stored late. Some drivers generate code only when a kernel is first launched, so that a binary
// taken earlier would leave that to every later run; and taking it costs PoCL .1-.3 s a program, for it then
// compiles a form for any group size as well. So it is done when nothing has been built for a while, or at the end.
class ProgramShelf
{
public:
    // The program of this text: here already, else from the disk cache, else built. `name` is for errors.
    // Throws DeviceError with the build log.
    std::shared_ptr<Program> get(Device::State& device, const std::string& name, const std::string& text);

    // Code of one of the program's kernels has been generated: its binary is worth keeping.
    void generated_code(const std::shared_ptr<Program>& program);

    // Stores one waiting binary if nothing has been built lately. Cheap when there is none. Never throws.
    void store_when_idle();
    void store_all();

private:
    using Clock = std::chrono::steady_clock;

    std::mutex mutex_;
    std::unordered_map<std::string, std::shared_ptr<Program>> programs_; // by cache key
    std::vector<std::shared_ptr<Program>> unstored_;
    Clock::time_point last_build_{};
};

} // namespace sundog
