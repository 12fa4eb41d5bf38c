#include "base/file_lock.h"

#include "base/errors.h"
#include "base/log.h"
#include "base/output_path.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sundog {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_stem = 200; // of the 255 bytes that a name may have

// The same for all links and spellings of a path.
fs::path lock_name(const fs::path& path)
{
    std::error_code error;
    const fs::path target = fs::weakly_canonical(fs::absolute(find_output(path).path), error);
    return target.parent_path() / ("." + target.filename().string().substr(0, longest_stem) + ".lock");
}

// Whether the name still means the open file.
bool is_named(const fs::path& name, int descriptor)
{
    struct stat open = {}, named = {};
    return ::fstat(descriptor, &open) == 0 && ::stat(name.c_str(), &named) == 0 && open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

} // namespace

FileLock::FileLock(const fs::path& path) : lock_(lock_name(path))
{
    while (!take(path)) {
    }
}

bool FileLock::take(const fs::path& path)
{
    descriptor_ = ::open(lock_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw FileError(path.string() + ": cannot make " + lock_.string() + ", which locks it: " + std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
        if (is_named(lock_, descriptor_)) return true;
        ::close(descriptor_);
        return false;
    }
    const int error = errno;
    if (error == EWOULDBLOCK) {
        ::close(descriptor_);
        throw FileError(path.string() + ": another sundog is using it; wait until that has ended, or give another file");
    }
    log_warning(path.string() + ": cannot be locked (" + std::strerror(error) + "); see to it that only one sundog uses it");
    return true;
}

FileLock::~FileLock()
{
    ::unlink(lock_.c_str()); // while it is held: whoever opens it from now on sees that it is not the one
    ::close(descriptor_);
}

} // namespace sundog
