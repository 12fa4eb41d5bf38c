// Ctrl-C and SIGTERM: stop in order, with what was done saved.
#pragma once

#include "base/errors.h"

namespace sundog {

// The render was asked to stop in the middle of an iteration, and did.
class Interrupted : public Error {
public:
    Interrupted() : Error(ExitStatus::interrupted, "interrupted before the first iteration was done: there is no image to save") {}
};

// Until defer_interrupts(), a signal ends the process at once with status 130: nothing has been rendered
// that could be saved.
void install_interrupt_handler();

// From here on the first signal only sets the flag below, so that the iteration can finish and the image
// be written; a second signal ends the process.
void defer_interrupts();

bool interrupt_requested();

} // namespace sundog
