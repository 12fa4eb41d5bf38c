#include "base/atomic_file.h"

#include "base/errors.h"
#include "base/output_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <random>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sundog {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t random_digits = 16;
constexpr std::string_view temporary_ending = ".tmp";
constexpr std::size_t longest_name = 255; // of a file, in bytes
constexpr std::size_t longest_stem = 200; // what a temporary name takes of it

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error)
{
    std::string cure;
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) cure = "; free some space or write elsewhere";
    if (error == EACCES || error == EPERM || error == EROFS) cure = "; choose a folder that you may write to";
    throw FileError(path.string() + ": " + what + ": " + std::strerror(error) + cure);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

void check_place(const OutputTarget& target)
{
    const fs::path& path = target.path;
    std::error_code error;
    if (path.filename().empty() || target.kind == OutputKind::folder) throw FileError(path.string() + ": cannot write, it is a folder; give a file name");
    if (path.filename().native().size() > longest_name) fail(path, "cannot write", ENAMETOOLONG);
    if (target.kind == OutputKind::descriptor && ::fcntl(target.descriptor, F_GETFL) < 0) fail(path, "cannot write", errno);
    if (target.kind == OutputKind::unusable) throw FileError(path.string() + ": cannot write, it is a socket or a disk; give a file name");
    if (!fs::is_directory(folder_of(path), error))
        throw FileError(path.string() + ": cannot write, there is no folder " + folder_of(path).string() + "; create it first");
    if (target.kind != OutputKind::descriptor && fs::exists(path, error) && ::access(path.c_str(), W_OK) != 0) fail(path, "cannot be replaced", errno);
}

// The path of a regular file.
fs::path replaceable(const fs::path& path)
{
    const OutputTarget target = find_output(path);
    check_place(target);
    if (target.kind != OutputKind::file) throw FileError(path.string() + ": cannot be replaced, it is a device or a pipe; give a file name");
    return target.path;
}

// What the names of all temporary files of a path start with.
std::string temporary_stem(const fs::path& path) { return "." + path.filename().string().substr(0, longest_stem) + "."; }

fs::path temporary_name(const fs::path& path)
{
    std::random_device random;
    const std::uint64_t number = std::uint64_t(random()) << 32 | random();
    return path.parent_path() / fmt::format("{}{:0{}x}{}", temporary_stem(path), number, random_digits, temporary_ending);
}

bool is_temporary_name(std::string_view name, std::string_view stem)
{
    if (name.size() != stem.size() + random_digits + temporary_ending.size() || !name.starts_with(stem) || !name.ends_with(temporary_ending)) return false;
    return name.substr(stem.size(), random_digits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// Nobody writes a file that can be locked.
void remove_if_stale(const fs::path& temporary)
{
    const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(temporary.c_str());
    ::close(descriptor);
}

void remove_stale(const fs::path& path)
{
    const std::string stem = temporary_stem(path);
    std::error_code error;
    for (fs::directory_iterator entry(folder_of(path), error), end; !error && entry != end; entry.increment(error))
        if (is_temporary_name(entry->path().filename().string(), stem)) remove_if_stale(entry->path());
}

void write_all(int descriptor, std::string_view bytes, const fs::path& path)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path, "cannot write", errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void write_straight(const OutputTarget& target, std::string_view bytes)
{
    const int descriptor = target.kind == OutputKind::descriptor ? ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0)
                                                                 : ::open(target.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) fail(target.path, "cannot write", errno);
    try {
        write_all(descriptor, bytes, target.path);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    if (::close(descriptor) != 0 && errno != EINTR) fail(target.path, "cannot write", errno);
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path) : final_(replaceable(path))
{
    remove_stale(final_);
    while (!create_temporary()) {
    }
}

bool AtomicFile::create_temporary()
{
    do {
        temporary_ = temporary_name(final_);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) fail(final_, "cannot write", errno);
    // Where a file system has no locks nothing is ever taken for stale.
    while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat file = {};
    if (::fstat(descriptor_, &file) != 0 || file.st_nlink > 0) return true;
    ::close(descriptor_); // before it was locked another process took it for stale
    return false;
}

AtomicFile::~AtomicFile()
{
    if (!committed_) ::unlink(temporary_.c_str());
    if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::write(std::string_view bytes) { write_all(descriptor_, bytes, final_); }

// Data reaches the disk before the name does: a crash cannot leave an empty file under it.
void AtomicFile::commit()
{
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(final_, "cannot write", errno);
    if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail(final_, "cannot rename to it", errno);
    committed_ = true;
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 && errno != EINTR) fail(final_, "cannot write", errno);
}

void write_file(const fs::path& path, std::string_view bytes)
{
    const OutputTarget target = find_output(path);
    if (target.kind == OutputKind::stream || target.kind == OutputKind::descriptor) return write_straight(target, bytes);
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

void check_file_writable(const fs::path& path)
{
    const OutputTarget target = find_output(path);
    if (target.kind == OutputKind::stream || target.kind == OutputKind::descriptor) check_place(target);
    else check_file_replaceable(path);
}

void check_file_replaceable(const fs::path& path) { const AtomicFile probe(path); }

} // namespace sundog
