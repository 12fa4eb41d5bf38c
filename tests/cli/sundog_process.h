// Runs the built executable in a folder of its own and tells what came of it.
#pragma once

#include "support/places.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace sundog::cli {

struct Outcome {
    int status = -1; // exit status; 128 + signal when killed by one
    std::string out;
    std::string err;
};

// Called with all of stderr so far; returns true once, when `signal` is to be sent.
struct Interruption {
    std::function<bool(const std::string& err)> when;
    int signal = SIGINT;
};

class Pipe {
public:
    Pipe()
    {
        if (::pipe(ends_) != 0) std::abort();
    }
    ~Pipe()
    {
        close(0);
        close(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    int end(int which) const { return ends_[which]; }
    void close(int which)
    {
        if (ends_[which] >= 0) ::close(ends_[which]);
        ends_[which] = -1;
    }
    // Appends what there is; false at the end of the stream.
    bool read_some(std::string& text)
    {
        char buffer[4096];
        const ssize_t count = ::read(ends_[0], buffer, sizeof buffer);
        if (count < 0) return errno == EINTR;
        text.append(buffer, static_cast<std::size_t>(count));
        return count > 0;
    }

private:
    int ends_[2] = {-1, -1};
};

[[noreturn]] inline void become_sundog(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                       const std::map<std::string, std::string>& environment, Pipe& out, Pipe& err)
{
    ::dup2(out.end(1), STDOUT_FILENO);
    ::dup2(err.end(1), STDERR_FILENO);
    for (int which : {0, 1}) {
        out.close(which);
        err.close(which);
    }
    std::filesystem::current_path(folder);
    std::signal(SIGHUP, SIG_DFL); // also where the tests run under nohup, which sundog would keep to
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> argv{const_cast<char*>("sundog")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    ::execv(test::sundog_executable().c_str(), argv.data());
    ::_exit(127);
}

// A command that takes longer hangs, and is killed.
constexpr std::chrono::seconds time_limit{120};

// Arguments without the program's name.
inline Outcome run_sundog(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const std::map<std::string, std::string>& environment = {}, Interruption interruption = {})
{
    Pipe out, err;
    const pid_t child = ::fork();
    if (child == 0) become_sundog(arguments, folder, environment, out, err);
    out.close(1);
    err.close(1);

    Outcome outcome;
    const auto deadline = std::chrono::steady_clock::now() + time_limit;
    pollfd streams[2] = {{out.end(0), POLLIN, 0}, {err.end(0), POLLIN, 0}};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        const int ready = left.count() > 0 ? ::poll(streams, 2, static_cast<int>(left.count())) : 0;
        if (ready == 0) {
            ADD_FAILURE() << "sundog hangs";
            ::kill(child, SIGKILL);
            break;
        }
        if (ready < 0) continue; // a signal
        if (streams[0].fd >= 0 && streams[0].revents != 0 && !out.read_some(outcome.out)) streams[0].fd = -1;
        if (streams[1].fd >= 0 && streams[1].revents != 0 && !err.read_some(outcome.err)) streams[1].fd = -1;
        if (interruption.when && interruption.when(outcome.err)) {
            ::kill(child, interruption.signal);
            interruption.when = {};
        }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

// A fixture with a folder that goes away with the test.
class InFolder : public ::testing::Test {
protected:
    InFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "sundog-cli-XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
    }
    ~InFolder() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name, std::ios::binary) << text; }
    std::string read(const std::string& name) const
    {
        std::ifstream file(folder / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }
    std::vector<std::string> files() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }
    Outcome run(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment = {}, Interruption interruption = {}) const
    {
        return run_sundog(arguments, folder, environment, std::move(interruption));
    }

    std::filesystem::path folder;
};

// The contract of every failure: the status, one line on stderr that starts and reads as promised, nothing
// on stdout.
inline void expect_failure(const Outcome& outcome, int status, const std::vector<std::string>& parts)
{
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_THAT(outcome.err, ::testing::StartsWith("sundog: error: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, ::testing::HasSubstr(part));
    EXPECT_EQ(outcome.out, "");
}

} // namespace sundog::cli
