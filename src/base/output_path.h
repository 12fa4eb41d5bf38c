// What the name of an output stands for.
#pragma once

#include <filesystem>

namespace sundog {

enum class OutputKind {
    file,       // a regular file, or none yet
    folder,
    descriptor, // one of this process: /dev/stdout, /dev/fd/3
    stream,     // a FIFO, a terminal, /dev/null, ...: written straight into, never replaced
    unusable,   // a socket or a disk
};

struct OutputTarget {
    OutputKind kind = OutputKind::file;
    std::filesystem::path path; // at the end of all symbolic links, of which the last may lead to a file that is not there yet
    int descriptor = -1;        // of OutputKind::descriptor
};

// Follows symbolic links, also those that lead nowhere yet. Throws FileError where links go round in a circle.
OutputTarget find_output(const std::filesystem::path& path);

// Whether two names mean one file, by whatever links or spellings. Devices and FIFOs are no such file: several may write there.
bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace sundog
