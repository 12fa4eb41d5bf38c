#include "base/interrupt.h"

#include "base/errors.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <unistd.h>

namespace sundog {

namespace {

constexpr std::int64_t by_hand = 1'000'000'000; // ns between two signals that one hand sends

std::atomic<bool> deferred{false};
std::atomic<bool> requested{false};
std::atomic<std::int64_t> first_ctrl_c{0}; // ns; 0: none yet
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free, "the signal handler needs it");

std::int64_t now()
{
    timespec time = {};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

bool is_second_ctrl_c(int signal)
{
    if (signal != SIGINT) return false;
    const std::int64_t first = first_ctrl_c;
    if (first == 0) first_ctrl_c = now();
    return first != 0 && now() - first >= by_hand;
}

// Calls only async-signal-safe functions.
void on_signal(int signal)
{
    const int error = errno;
    if (!deferred && signal != SIGXFSZ) ::_exit(static_cast<int>(ExitStatus::interrupted));
    if (deferred) {
        if (is_second_ctrl_c(signal)) ::_exit(static_cast<int>(ExitStatus::interrupted));
        requested = true;
    }
    errno = error;
}

} // namespace

void install_interrupt_handler()
{
    struct sigaction action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) {
        struct sigaction inherited = {};
        sigaction(signal, nullptr, &inherited);
        const bool outlives_terminal = signal == SIGHUP && inherited.sa_handler == SIG_IGN; // nohup
        if (!outlives_terminal) sigaction(signal, &action, nullptr);
    }
}

void defer_interrupts() { deferred = true; }

// A compiler inside the OpenCL driver (LLVM) takes signals over when it starts, in the middle of the first iteration.
bool interrupt_requested()
{
    install_interrupt_handler();
    return requested;
}

} // namespace sundog
