#include "base/atomic_file.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace sundog {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error)
{
    std::string cure;
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) cure = "; free some space or write elsewhere";
    if (error == EACCES || error == EPERM || error == EROFS) cure = "; choose a folder that you may write to";
    throw FileError(path.string() + ": " + what + ": " + std::strerror(error) + cure);
}

fs::path resolve_link(const fs::path& path)
{
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    const fs::path target = fs::weakly_canonical(path, error);
    return error ? path : target;
}

void check_place(const fs::path& path)
{
    std::error_code error;
    if (path.filename().empty() || fs::is_directory(path, error))
        throw FileError(path.string() + ": cannot write, it is a folder; give a file name");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw FileError(path.string() + ": cannot write, there is no folder " + folder.string() + "; create it first");
    if (fs::exists(path, error) && ::access(path.c_str(), W_OK) != 0) fail(path, "cannot be replaced", errno);
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path) : final_(resolve_link(path))
{
    check_place(final_);
    static std::atomic<unsigned> counter{0};
    temporary_ = final_.parent_path() / fmt::format(".{}.{}.{}.tmp", final_.filename().string(), ::getpid(), counter.fetch_add(1));
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(final_, "cannot write", errno);
}

AtomicFile::~AtomicFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(final_, "cannot write", errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

// Data reaches the disk before the name does: a crash cannot leave an empty file under it.
void AtomicFile::commit()
{
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(final_, "cannot write", errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 && errno != EINTR) fail(final_, "cannot write", errno);
    if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail(final_, "cannot rename to it", errno);
    committed_ = true;
}

void write_file_atomically(const fs::path& path, std::string_view bytes)
{
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

void check_file_writable(const fs::path& path)
{
    const AtomicFile probe(path);
}

} // namespace sundog
