// The disk cache of program binaries: cold, warm, damaged, unwritable, and shared by processes.
#include "child_process.h"
#include "device/binary_cache.h"
#include "device/kernel.h"
#include "device/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>

namespace sundog
{
namespace
{

namespace fs = std::filesystem;

constexpr std::string_view double_source = R"(
__kernel void twice(__global uint* numbers, const uint count)
{
    uint i = get_global_id(0);
    if (i < count) numbers[i] *= FACTOR;
}
)";

struct RunReport {
    std::uint64_t built, loaded;
    bool correct, refuses_wrong_type;
};

// Opens a device, runs the kernel once and closes the device, which stores what is to be stored.
RunReport run_once(const std::string& factor = "2u")
{
    Device device(select_device(""));
    const Kernel twice = Kernel::from_source(device, "twice", "Double", double_source, {.defines = {{"FACTOR", factor}}, .prelude = {}});
    RunReport report{};
    Buffer<float> wrong(device, 100, "wrong");
    try {
        twice(100, wrong, 100u);
    } catch (const std::logic_error&) {
        report.refuses_wrong_type = true;
    }
    Buffer<unsigned> numbers(device, std::vector<unsigned>(100, 21u), "numbers");
    twice(100, numbers, 100u);
    report.correct = numbers.download() == std::vector<unsigned>(100, 42u);
    report.built = device.profile().programs_built();
    report.loaded = device.profile().programs_loaded();
    return report;
}

// Sets an environment variable (nullptr: removes it) until the end of its scope.
class ScopedVariable
{
public:
    ScopedVariable(const char* name, const char* value) : name_(name)
    {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~ScopedVariable() { set(before_ ? before_->c_str() : nullptr); }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

private:
    void set(const char* value) { value ? ::setenv(name_, value, 1) : ::unsetenv(name_); }

    const char* name_;
    std::optional<std::string> before_;
};

class DeviceCache : public testing::Test
{
protected:
    std::vector<fs::path> files() const { return {fs::directory_iterator(folder_.path()), fs::directory_iterator()}; }

    TemporaryFolder folder_;
    ScopedVariable variable_{"SUNDOG_CACHE_DIR", folder_.string().c_str()};
};

void expect_built(const RunReport& report)
{
    EXPECT_EQ(report.built, 1u);
    EXPECT_EQ(report.loaded, 0u);
    EXPECT_TRUE(report.correct);
}

void expect_loaded(const RunReport& report)
{
    EXPECT_EQ(report.built, 0u);
    EXPECT_EQ(report.loaded, 1u);
    EXPECT_TRUE(report.correct);
}

TEST_F(DeviceCache, LoadsWhatAnEarlierRunBuilt)
{
    expect_built(run_once());
    ASSERT_EQ(files().size(), 1u);
    const RunReport warm = run_once();
    expect_loaded(warm);
    EXPECT_TRUE(warm.refuses_wrong_type) << "argument names and types do not survive the cache";
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(DeviceCache, TellsProgramsApartByDefines)
{
    expect_built(run_once("2u"));
    expect_built(run_once("(1u+1u)"));
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(DeviceCache, RebuildsDamagedFiles)
{
    expect_built(run_once());
    const fs::path file = files().at(0);
    const auto size = fs::file_size(file);

    fs::resize_file(file, size / 2);
    expect_built(run_once());
    EXPECT_EQ(fs::file_size(file), size) << "the damaged file was not replaced";
    expect_loaded(run_once());

    fs::resize_file(file, 5);
    expect_built(run_once());

    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(std::streamoff(size - 100)).put('\x5a').put('\x5b');
    expect_built(run_once());
    expect_loaded(run_once());
}

TEST_F(DeviceCache, RebuildsWhatTheDriverRefuses)
{
    expect_built(run_once());
    const std::string key = files().at(0).stem().string();
    store_cached_binary(key, "intact on disk, but no program");
    ASSERT_TRUE(load_cached_binary(key));
    expect_built(run_once());
    expect_loaded(run_once());
}

TEST_F(DeviceCache, WorksWithoutAWritableFolder)
{
    std::ofstream(folder_.path() / "file") << "not a folder";
    const ScopedVariable below("SUNDOG_CACHE_DIR", (folder_.path() / "file" / "below").c_str());
    expect_built(run_once());
    expect_built(run_once());
}

TEST_F(DeviceCache, FolderFollowsTheEnvironment)
{
    EXPECT_EQ(program_cache_directory(), folder_.string());
    const ScopedVariable home("HOME", "/nowhere/somebody");
    const ScopedVariable shared("XDG_CACHE_HOME", "/somewhere/cache");
    const ScopedVariable none("SUNDOG_CACHE_DIR", nullptr);
    EXPECT_EQ(program_cache_directory(), "/somewhere/cache/sundog");
    const ScopedVariable not_shared("XDG_CACHE_HOME", "");
    EXPECT_EQ(program_cache_directory(), "/nowhere/somebody/.cache/sundog");
}

TEST(DeviceCacheChild, DISABLED_BuildsOrLoads)
{
    const RunReport report = run_once();
    EXPECT_TRUE(report.correct);
    EXPECT_EQ(report.built + report.loaded, 1u);
}

TEST_F(DeviceCache, ServesProcessesThatStartTogether)
{
    const TemporaryFolder driver_cache; // PoCL's own cache starts empty as well
    const std::string environment = "SUNDOG_CACHE_DIR=" + folder_.string() + " POCL_CACHE_DIR=" + driver_cache.string();
    const auto results = run_children(std::vector<std::string>(6, environment), "DeviceCacheChild.DISABLED_BuildsOrLoads");
    for (const auto& result : results) EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(files().size(), 1u) << "temporary files were left behind";
    expect_loaded(run_once());
}

} // namespace
} // namespace sundog
