// Where outputs go: files whole or not at all, devices and pipes straight, links to where they lead; and who may write them.
#include "base/atomic_file.h"
#include "base/errors.h"
#include "base/file_lock.h"
#include "base/output_path.h"
#include "base/readable_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace sundog {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class OutputFiles : public ::testing::Test {
protected:
    OutputFiles()
    {
        std::string pattern = (fs::temp_directory_path() / "sundog-output-XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
    }
    ~OutputFiles() override { fs::remove_all(folder); }

    std::string read(const std::string& name) const
    {
        std::ifstream file(folder / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }
    void touch(const std::string& name) const { std::ofstream(folder / name) << "old"; }
    std::vector<std::string> files() const
    {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
        return names;
    }
    std::string error_of(const std::function<void()>& action) const
    {
        try {
            action();
        } catch (const FileError& error) {
            return error.what();
        }
        return "no error";
    }

    fs::path folder;
};

TEST_F(OutputFiles, a_file_appears_whole_or_not_at_all)
{
    touch("a");
    {
        AtomicFile file(folder / "a");
        file.write("new");
        EXPECT_EQ(read("a"), "old");
    }
    EXPECT_THAT(files(), ElementsAre("a"));
    write_file(folder / "a", "new");
    EXPECT_EQ(read("a"), "new");
    EXPECT_THAT(files(), ElementsAre("a"));
}

// A killed process leaves its temporary file; one that is being written stays.
TEST_F(OutputFiles, what_killed_processes_left_is_removed_by_the_next_write)
{
    touch(".a.0123456789abcdef.tmp");
    touch(".b.0123456789abcdef.tmp");
    touch(".a.0123456789abcdeg.tmp");
    touch(".a.tmp");
    AtomicFile other(folder / "a");
    std::vector<std::string> before = files();
    write_file(folder / "a", "new");
    EXPECT_EQ(files().size(), before.size() + 1) << "the file under way is kept";
    other.write("newer");
    other.commit();
    EXPECT_THAT(files(), UnorderedElementsAre("a", ".b.0123456789abcdef.tmp", ".a.0123456789abcdeg.tmp", ".a.tmp"));
    EXPECT_EQ(read("a"), "newer");
}

TEST_F(OutputFiles, names_of_temporary_files_do_not_repeat_with_process_numbers)
{
    const auto name_in_child = [&] {
        const pid_t child = ::fork();
        if (child == 0) {
            const AtomicFile file(folder / "a");
            ::_exit(0); // as if killed
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return files().at(0);
    };
    const std::string first = name_in_child(), second = name_in_child();
    EXPECT_NE(first, second);
    EXPECT_EQ(files().size(), 1u) << "the first one's file was removed by the second";
}

TEST_F(OutputFiles, links_are_followed_also_where_they_lead_nowhere_yet)
{
    fs::create_directory(folder / "far");
    fs::create_symlink("far/target", folder / "dangling");
    fs::create_symlink("dangling", folder / "twice");
    write_file(folder / "twice", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
    EXPECT_TRUE(fs::is_symlink(folder / "twice"));
    EXPECT_EQ(read("far/target"), "new");
    fs::create_symlink("round", folder / "go");
    fs::create_symlink("go", folder / "round");
    EXPECT_THAT(error_of([&] { write_file(folder / "go", "new"); }), HasSubstr("symbolic links go round in a circle"));
}

TEST_F(OutputFiles, a_fifo_is_written_into_and_stays)
{
    ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
    check_file_writable(folder / "fifo"); // does not wait for a reader
    std::string got;
    std::thread reader([&] { got = read("fifo"); });
    write_file(folder / "fifo", "through");
    reader.join();
    EXPECT_EQ(got, "through");
    EXPECT_TRUE(fs::is_fifo(folder / "fifo"));
    EXPECT_THAT(error_of([&] { check_file_replaceable(folder / "fifo"); }), HasSubstr("it is a device or a pipe; give a file name"));
}

TEST_F(OutputFiles, a_device_stays_one)
{
    if (::mknod((folder / "null").c_str(), S_IFCHR | 0600, 0x103) != 0) GTEST_SKIP() << "no right to make a device";
    fs::create_symlink("null", folder / "link");
    for (const char* name : {"null", "link"}) {
        try {
            write_file(folder / name, "gone");
        } catch (const FileError&) {
            // Where devices of this file system are off.
        }
        EXPECT_TRUE(fs::is_character_file(folder / "null"));
        EXPECT_THAT(error_of([&] { AtomicFile file(folder / name); }), HasSubstr("device"));
    }
}

// As /dev/stdout, which leads to such a name: text goes behind what was there.
TEST_F(OutputFiles, a_descriptor_of_this_process_is_written_to_where_it_stands)
{
    touch("log");
    const int descriptor = ::open((folder / "log").c_str(), O_WRONLY | O_APPEND);
    const std::string name = "/proc/self/fd/" + std::to_string(descriptor);
    fs::create_symlink(name, folder / "link");
    write_file(name, " one");
    write_file(folder / "link", " two");
    ::close(descriptor);
    EXPECT_EQ(read("log"), "old one two");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_THAT(error_of([&] { check_file_writable(name); }), HasSubstr("Bad file descriptor"));
}

TEST_F(OutputFiles, one_file_by_other_links_and_spellings)
{
    touch("a");
    fs::create_symlink("a", folder / "link");
    fs::create_hard_link(folder / "a", folder / "hard");
    fs::create_symlink("new", folder / "dangling");
    for (const char* name : {"a", "./a", "../x/a", "link", "hard"}) {
        const fs::path other = std::string(name) == "../x/a" ? folder / ".." / folder.filename() / "a" : folder / name;
        EXPECT_TRUE(are_one_file(folder / "a", other)) << other;
    }
    EXPECT_TRUE(are_one_file(folder / "new", folder / "dangling"));
    EXPECT_TRUE(are_one_file(folder / "new", folder / "." / "new"));
    EXPECT_FALSE(are_one_file(folder / "a", folder / "new"));
    EXPECT_FALSE(are_one_file("/dev/null", "/dev/null")) << "several may write there";
}

TEST_F(OutputFiles, names_that_cannot_be_are_found_before_the_work)
{
    EXPECT_THAT(error_of([&] { check_file_writable(folder / std::string(300, 'x')); }), HasSubstr("File name too long"));
    EXPECT_NO_THROW(write_file(folder / std::string(255, 'x'), "new"));
}

// As another user, for root may read everything.
TEST_F(OutputFiles, a_file_without_permission_says_so)
{
    touch("secret");
    fs::permissions(folder, fs::perms::all);
    fs::permissions(folder / "secret", fs::perms::none);
    const pid_t child = ::fork();
    if (child == 0) {
        if (::geteuid() == 0 && ::seteuid(65534) != 0) ::_exit(3);
        const std::string error = error_of([&] { check_file_readable(folder / "secret"); });
        ::_exit(error.ends_with("secret: cannot read: Permission denied; give yourself permission to read it (chmod)") ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(OutputFiles, a_lock_is_held_by_one_process_and_survives_a_replaced_file)
{
    fs::create_symlink("c", folder / "link");
    const auto in_child = [&](const char* name) {
        const pid_t child = ::fork();
        if (child == 0) {
            try {
                const FileLock lock(folder / name);
                ::_exit(0);
            } catch (const FileError& error) {
                ::_exit(std::string(error.what()).find("another sundog is using it") != std::string::npos ? 1 : 2);
            }
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return WEXITSTATUS(status);
    };
    std::optional<FileLock> lock(folder / "c");
    EXPECT_EQ(in_child("c"), 1);
    write_file(folder / "c", "saved");
    EXPECT_EQ(in_child("c"), 1);
    EXPECT_EQ(in_child("link"), 1);
    EXPECT_EQ(in_child("d"), 0);
    lock.reset();
    EXPECT_EQ(in_child("c"), 0); // ends without giving the lock back
    EXPECT_EQ(in_child("c"), 0);
}

} // namespace
} // namespace sundog
