// Ctrl-C: at once before there is anything to save, in order afterwards, and at once the second time.
#include "base/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

namespace sundog {
namespace {

// Exit status of a child that runs `action` and then ends with 7.
template <class Action> int status_of(Action action)
{
    const pid_t child = ::fork();
    if (child == 0) {
        install_interrupt_handler();
        action();
        ::_exit(7);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ProgressInterrupt, ends_at_once_before_rendering)
{
    for (int signal : {SIGINT, SIGTERM})
        EXPECT_EQ(status_of([signal] { std::raise(signal); }), 130);
}

TEST(ProgressInterrupt, first_signal_is_deferred)
{
    for (int signal : {SIGINT, SIGTERM}) {
        const auto interrupted = [signal] {
            defer_interrupts();
            if (interrupt_requested()) ::_exit(8);
            std::raise(signal);
            if (!interrupt_requested()) ::_exit(9);
        };
        EXPECT_EQ(status_of(interrupted), 7);
    }
}

TEST(ProgressInterrupt, second_signal_ends)
{
    const auto twice = [] {
        defer_interrupts();
        std::raise(SIGINT);
        std::raise(SIGTERM);
    };
    EXPECT_EQ(status_of(twice), 130);
}

} // namespace
} // namespace sundog
