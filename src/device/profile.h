// What a render cost: seconds per stage by device events, seconds of kernel builds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sundog
{

struct StageTime {
    std::string label; // the kernel's phrase
    double seconds = 0.0;
    std::uint64_t launches = 0;
};

// Filled by Kernel. Events of finished launches are folded in when asked for.
class Profile
{
public:
    virtual ~Profile() = default;
    virtual std::vector<StageTime> stages() = 0; // waits for the device; in order of first launch
    // Whether seconds of stages mean seconds, as far as the host can tell; waits. On some drivers they do not.
    virtual bool tells_seconds() = 0;
    // Building or loading programs, and generating code at first launches.
    virtual double build_seconds() const = 0;
    virtual std::uint64_t programs_built() const = 0;  // from source
    virtual std::uint64_t programs_loaded() const = 0; // from the disk cache
    virtual void reset() = 0;
};

} // namespace sundog
