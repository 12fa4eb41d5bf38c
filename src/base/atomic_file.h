// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace sundog {

// A file that is written beside `path`, in the same folder, and renamed to it by commit(): `path` never holds a
// part, and keeps its old content when something fails. A symbolic link is followed. All throw FileError (missing
// folder, no permission, full disk, ...). Without a commit() nothing is left behind.
class AtomicFile {
public:
    explicit AtomicFile(const std::filesystem::path& path);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    void write(std::string_view bytes);
    void commit();

private:
    std::filesystem::path final_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    bool committed_ = false;
};

// All of it at once.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// Finds out early what would make write_file_atomically(path) fail: creates an empty file beside `path`
// and removes it. Throws FileError.
void check_file_writable(const std::filesystem::path& path);

} // namespace sundog
