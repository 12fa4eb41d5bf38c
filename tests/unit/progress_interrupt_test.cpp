// Signals that end a process: at once before there is anything to save, in order afterwards; a second Ctrl-C at once.
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

constexpr int all_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};

TEST(ProgressInterrupt, ends_at_once_before_rendering)
{
    for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE})
        EXPECT_EQ(status_of([signal] { std::raise(signal); }), 130) << signal;
    // The write that caused it says more.
    EXPECT_EQ(status_of([] { std::raise(SIGXFSZ); }), 7);
}

TEST(ProgressInterrupt, first_signal_is_deferred)
{
    for (int signal : all_signals) {
        const auto interrupted = [signal] {
            defer_interrupts();
            if (interrupt_requested()) ::_exit(8);
            std::raise(signal);
            if (!interrupt_requested()) ::_exit(9);
        };
        EXPECT_EQ(status_of(interrupted), 7) << signal;
    }
}

// `timeout` signals the process and then its group.
TEST(ProgressInterrupt, the_same_signal_twice_is_one_request)
{
    for (int signal : all_signals) {
        const auto twice = [signal] {
            defer_interrupts();
            std::raise(signal);
            std::raise(signal);
        };
        EXPECT_EQ(status_of(twice), 7) << signal;
    }
}

void wait_for_a_hand() { ::usleep(1'050'000); }

TEST(ProgressInterrupt, only_a_second_ctrl_c_by_hand_ends)
{
    const auto by_hand = [](int first, int second) {
        return [first, second] {
            defer_interrupts();
            std::raise(first);
            wait_for_a_hand();
            std::raise(second);
        };
    };
    EXPECT_EQ(status_of(by_hand(SIGINT, SIGINT)), 130);
    EXPECT_EQ(status_of(by_hand(SIGTERM, SIGTERM)), 7);
    EXPECT_EQ(status_of(by_hand(SIGTERM, SIGINT)), 7);
}

TEST(ProgressInterrupt, nohup_is_kept)
{
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGHUP, SIG_IGN);
        install_interrupt_handler();
        std::raise(SIGHUP);
        ::_exit(7);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 7);
}

} // namespace
} // namespace sundog
