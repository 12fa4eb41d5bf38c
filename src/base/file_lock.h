// One process at a time on a file.
#pragma once

#include <filesystem>

namespace sundog {

// Holds `path` for this process, by a lock on .NAME.lock beside it: `path` itself is replaced while it is held. The lock
// goes with the process, however that ends. Throws FileError where another process holds it, or none can be made.
class FileLock {
public:
    explicit FileLock(const std::filesystem::path& path);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock();

private:
    bool take(const std::filesystem::path& path); // false: its holder has just removed it

    std::filesystem::path lock_;
    int descriptor_ = -1;
};

} // namespace sundog
