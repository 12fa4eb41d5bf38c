// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace sundog {

// A file that is written beside `path`, in the same folder, and renamed to it by commit(): `path` never holds a
// part, and keeps its old content when something fails. Symbolic links are followed. All throw FileError (missing
// folder, no permission, full disk, `path` is a device or a FIFO, ...). Without a commit() nothing is left behind.
//
// The file beside has a random name, and is locked while it is written. One without a lock was left by a process that was
// killed: the next file with the same `path` removes it.
class AtomicFile {
public:
    explicit AtomicFile(const std::filesystem::path& path);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    void write(std::string_view bytes);
    void commit();

private:
    bool create_temporary(); // false: another process took it away

    std::filesystem::path final_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    bool committed_ = false;
};

// All of it at once. A regular file is written as above; anything else (/dev/stdout, a FIFO) is written straight into and
// stays what it is.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// Finds out early what would make write_file(path) fail: creates an empty file beside `path` and removes it. Throws FileError.
void check_file_writable(const std::filesystem::path& path);

// The same for an AtomicFile, which takes the place of regular files alone.
void check_file_replaceable(const std::filesystem::path& path);

} // namespace sundog
