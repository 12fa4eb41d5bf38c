// The file that a render is continued from; photon maps are saved in the same layout. Layout, all numbers as the machine writes them (little endian):
//
//   8 bytes   "\x89SUNDOG\n"
//   uint32    version of this layout, checkpoint_layout
//   uint32    0x01020304, so that a machine of the other byte order sees it
//   sections, each:
//     uint32  bytes of the name
//     uint32  0
//     uint64  bytes of the data
//     name, data
//     uint64  low and uint64 high half of Hash().append_field(name).append_field(data)
//
// The section "end", without data, is the last: a file without it was cut off. The first one, "render", is JSON that
// says which render this is (render/checkpoint.h); the others are numbers and device buffers as they lie in memory.
#pragma once

#include "base/atomic_file.h"
#include "base/state_archive.h"

#include <cstdint>
#include <fstream>
#include <string>

namespace sundog {

constexpr std::uint32_t checkpoint_layout = 2;

// How messages speak of a file that cannot be read.
struct FileUse {
    std::string kind = "checkpoint";
    std::string failure = "cannot resume";
    std::string cure = "render afresh without --resume";
};

// Of a section's name and data.
struct CheckpointDigest {
    std::uint64_t low, high;
    bool operator==(const CheckpointDigest&) const = default;
};

// Writes beside FILE; only commit() puts it there. Throws FileError.
class CheckpointWriter final : public StateArchive {
public:
    explicit CheckpointWriter(const std::filesystem::path& file);

    bool loading() const override { return false; }
    void bytes(std::string_view name, std::span<std::byte> data) override;
    void blocks(std::string_view name, std::size_t elements, std::size_t element_bytes, const Exchange& exchange) override;
    std::uint64_t next_bytes() override { return 0; } // nothing is loaded
    [[noreturn]] void refuse(const std::string& why) const override;
    void text(std::string_view name, std::string_view text);
    void commit();

private:
    void section(std::string_view name, std::string_view data);

    AtomicFile file_;
};

// Throws FileError: no such file, no checkpoint, another layout or byte order, cut off, or changed since it was
// written. Data is given out only after its hash was found to be right; blocks are given out before that, and the last
// of them is followed by the exception.
class CheckpointReader final : public StateArchive {
public:
    explicit CheckpointReader(const std::filesystem::path& file, FileUse use = {});

    bool loading() const override { return true; }
    void bytes(std::string_view name, std::span<std::byte> data) override;
    void blocks(std::string_view name, std::size_t elements, std::size_t element_bytes, const Exchange& exchange) override;
    std::uint64_t next_bytes() override;
    std::string text(std::string_view name, std::uint64_t most_bytes);
    void finish(); // the archive ends here

    [[noreturn]] void refuse(const std::string& why) const override; // the file, for a reason that its reader found

private:
    std::uint64_t begin_section(std::string_view name);
    void expect_bytes(std::string_view name, std::uint64_t wanted);
    void end_section(std::string_view name, const CheckpointDigest& digest);
    void take(void* target, std::uint64_t bytes);

    std::filesystem::path path_;
    FileUse use_;
    std::ifstream file_;
    std::uint64_t left_ = 0; // bytes of the file not yet read
};

} // namespace sundog
