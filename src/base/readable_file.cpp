#include "base/readable_file.h"

#include "base/errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace sundog {

void check_file_readable(const std::filesystem::path& path)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); // does not wait for who writes a FIFO
    if (descriptor >= 0) {
        ::close(descriptor);
        return;
    }
    const int error = errno;
    const std::string cure = error == EACCES || error == EPERM ? "; give yourself permission to read it (chmod)" : "";
    throw FileError(path.string() + ": cannot read: " + std::strerror(error) + cure);
}

} // namespace sundog
