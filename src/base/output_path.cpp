#include "base/output_path.h"

#include "base/errors.h"

#include <charconv>
#include <optional>
#include <string>
#include <sys/stat.h>

namespace sundog {

namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40; // as many as Linux follows

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Of a name such as /proc/self/fd/1, to which /dev/stdout leads. Opened again, it would be written from its start.
std::optional<int> own_descriptor(const fs::path& path)
{
    std::error_code error;
    const fs::path folder = fs::canonical(folder_of(path), error), own = fs::canonical("/proc/self/fd", error);
    if (error || folder != own) return {};
    const std::string name = path.filename().string();
    int number = 0;
    const auto [end, failed] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (failed != std::errc() || end != name.data() + name.size()) return {};
    return number;
}

OutputKind kind_of(const fs::path& path)
{
    std::error_code error;
    switch (fs::status(path, error).type()) {
    case fs::file_type::directory:
        return OutputKind::folder;
    case fs::file_type::fifo:
    case fs::file_type::character:
        return OutputKind::stream;
    case fs::file_type::socket:
    case fs::file_type::block:
        return OutputKind::unusable;
    default:
        return OutputKind::file;
    }
}

} // namespace

OutputTarget find_output(const fs::path& path)
{
    std::error_code error;
    fs::path target = path;
    for (int links = 0; links < most_links; links++) {
        if (const auto descriptor = own_descriptor(target)) return {OutputKind::descriptor, target, *descriptor};
        if (!fs::is_symlink(target, error)) return {kind_of(target), target, -1};
        const fs::path next = fs::read_symlink(target, error);
        target = next.is_absolute() ? next : folder_of(target) / next;
    }
    throw FileError(path.string() + ": cannot write, its symbolic links go round in a circle; remove them or choose another name");
}

bool are_one_file(const fs::path& a, const fs::path& b)
{
    const OutputTarget first = find_output(a), second = find_output(b);
    if (first.kind != OutputKind::file || second.kind != OutputKind::file) return false;
    struct stat one = {}, other = {};
    const bool exists = ::stat(first.path.c_str(), &one) == 0, other_exists = ::stat(second.path.c_str(), &other) == 0;
    if (exists != other_exists) return false;
    if (exists) return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
    std::error_code error;
    return fs::weakly_canonical(fs::absolute(first.path), error) == fs::weakly_canonical(fs::absolute(second.path), error);
}

} // namespace sundog
