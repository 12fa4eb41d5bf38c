// What a user or a device did wrong. Bugs are asserts; these are exceptions, caught
// in main alone, and each carries the exit status of the command line's contract.
#pragma once

#include "base/printable.h"

#include <stdexcept>
#include <string>

namespace sundog {

enum class ExitStatus : int {
    done = 0,
    internal_error = 1,
    usage = 2,
    scene = 3,
    device = 4,
    file = 5,
    interrupted = 130,
};

// A place in a scene file. line 0: the file as a whole.
struct SourceLocation {
    std::string file;
    int line = 0;

    // "FILE:LINE: ", "FILE: " or "".
    std::string prefix() const
    {
        if (file.empty()) return {};
        return line > 0 ? file + ":" + std::to_string(line) + ": " : file + ": ";
    }
};

// The message says what is wrong and what to do, in one line; names in it are made printable. (After the first line of a
// DeviceError a build log may follow.)
class Error : public std::runtime_error {
public:
    Error(ExitStatus status, const std::string& message)
        : std::runtime_error(status == ExitStatus::device ? printable_lines(message) : printable(message)), status_(status)
    {
    }
    ExitStatus status() const { return status_; }

private:
    ExitStatus status_;
};

// A wrong argument, method, parameter or value on the command line.
class UsageError : public Error {
public:
    explicit UsageError(const std::string& message) : Error(ExitStatus::usage, message) {}
};

// A scene file, or what it refers to, cannot be rendered.
class SceneError : public Error {
public:
    SceneError(const SourceLocation& where, const std::string& message) : Error(ExitStatus::scene, where.prefix() + message) {}
};

// No device, or an OpenCL call failed.
class DeviceError : public Error {
public:
    explicit DeviceError(const std::string& message) : Error(ExitStatus::device, message) {}
};

// A file cannot be read or written (scene files excepted: a scene error).
class FileError : public Error {
public:
    explicit FileError(const std::string& message) : Error(ExitStatus::file, message) {}
};

} // namespace sundog
