// Faults on demand, for tests of what happens after them.
#pragma once

namespace sundog {

// Places that can be told to fail.
enum class FaultPoint { iterate, accumulate, image, checkpoint, preview };

// Throws where the environment variable SUNDOG_FAULT says so: "iterate@3:memory" at the third call for FaultPoint::iterate.
// Kinds: memory (std::bad_alloc), device (DeviceError), file (FileError) and other (std::runtime_error).
void fault_point(FaultPoint point);

} // namespace sundog
