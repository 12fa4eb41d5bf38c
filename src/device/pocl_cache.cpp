#include "device/pocl_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fcntl.h>
#include <mutex>
#include <unistd.h>
#include <utility>

namespace sundog
{

namespace
{

namespace fs = std::filesystem;

// What the programs of a render take, and some more.
constexpr off_t room_wanted = 16 << 20;

std::string variable(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

// As PoCL chooses it.
fs::path pocl_folder()
{
    if (const std::string own = variable("POCL_CACHE_DIR"); !own.empty()) return own;
    if (const std::string caches = variable("XDG_CACHE_HOME"); !caches.empty()) return fs::path(caches) / "pocl" / "kcache";
    if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "pocl" / "kcache";
    return "/tmp/pocl/kcache";
}

class TemporaryFolder
{
public:
    TemporaryFolder() = default;
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder()
    {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    // Below the first of these where there is room; empty where there is nowhere.
    const std::string& make()
    {
        std::error_code error;
        for (const std::string& parent : {fs::temp_directory_path(error).string(), std::string("/dev/shm"), std::string("/tmp")}) {
            std::string pattern = (fs::path(parent) / "sundog-pocl-XXXXXX").string();
            if (!::mkdtemp(pattern.data())) continue;
            path_ = pattern;
            if (writing_problem(path_).empty()) return path_;
            fs::remove_all(path_, error);
            path_.clear();
        }
        return path_;
    }

private:
    std::string path_;
};

std::string& warning()
{
    static std::string text;
    return text;
}

void provide()
{
    static TemporaryFolder folder;
    const std::string wanted = pocl_folder().string(), problem = writing_problem(wanted);
    if (problem.empty()) return;
    const std::string& other = folder.make();
    if (!other.empty()) ::setenv("POCL_CACHE_DIR", other.c_str(), 1);
    warning() = fmt::format("PoCL's cache {} cannot be written: {}; kernels are built anew this time (POCL_CACHE_DIR=FOLDER chooses another place)",
                            wanted, problem);
}

} // namespace

std::string writing_problem(const std::string& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return error.message();
    std::string probe = (fs::path(folder) / ".sundog-probe-XXXXXX").string();
    const int descriptor = ::mkstemp(probe.data());
    if (descriptor < 0) return std::strerror(errno);
    const int failed = ::posix_fallocate(descriptor, 0, room_wanted);
    ::unlink(probe.c_str());
    ::close(descriptor);
    return failed == 0 || failed == EINVAL || failed == EOPNOTSUPP ? "" : std::strerror(failed);
}

void provide_pocl_cache()
{
    static std::once_flag once;
    std::call_once(once, provide);
}

std::string take_pocl_cache_warning()
{
    return std::exchange(warning(), {});
}

std::string pocl_cache_problem()
{
    const std::string folder = pocl_folder().string(), problem = writing_problem(folder);
    if (problem.empty()) return {};
    return fmt::format("; PoCL's cache {} cannot be written: {}: free some space, or set POCL_CACHE_DIR to another folder", folder, problem);
}

} // namespace sundog
