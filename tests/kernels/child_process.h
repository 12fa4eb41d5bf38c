// Runs tests of this executable in processes of their own, where environment variables take effect from the start.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/wait.h>

namespace sundog
{

struct ChildResult {
    int status = -1; // exit status; -1 when it was ended by a signal
    std::string output;
};

// A test that only runs as a child is named DISABLED_...; environment: "NAME=value NAME=value", without spaces in values.
// All children run at the same time, each the whole test, also where this process runs a shard of the tests.
// In sanitized builds without the leak checker, which cannot trace PoCL's threads.
inline std::vector<ChildResult> run_children(const std::vector<std::string>& environments, const std::string& test)
{
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<FILE*> pipes;
    for (const auto& environment : environments) {
        const std::string command = "env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX ASAN_OPTIONS=detect_leaks=0 " + environment + " '" + self +
                                    "' --gtest_also_run_disabled_tests --gtest_filter=" + test + " 2>&1";
        pipes.push_back(::popen(command.c_str(), "r"));
    }
    std::vector<ChildResult> results;
    for (FILE* pipe : pipes) {
        ChildResult result;
        for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) result.output.push_back(char(c));
        const int status = ::pclose(pipe);
        if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
        results.push_back(result);
    }
    return results;
}

inline ChildResult run_child(const std::string& environment, const std::string& test)
{
    return run_children({environment}, test).front();
}

// A fresh folder, removed with all it holds at the end.
class TemporaryFolder
{
public:
    TemporaryFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "sundog-test-XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::string string() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

} // namespace sundog
