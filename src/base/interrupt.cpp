#include "base/interrupt.h"

#include "base/errors.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace sundog {

namespace {

std::atomic<bool> deferred{false};
std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler needs it");

// Calls only async-signal-safe functions.
void on_signal(int)
{
    if (!deferred || requested) _exit(static_cast<int>(ExitStatus::interrupted));
    requested = true;
}

} // namespace

void install_interrupt_handler()
{
    struct sigaction action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

void defer_interrupts() { deferred = true; }

bool interrupt_requested() { return requested; }

} // namespace sundog
