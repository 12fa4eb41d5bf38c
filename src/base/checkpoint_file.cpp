#include "base/checkpoint_file.h"

#include "base/errors.h"
#include "base/hash.h"
#include "base/readable_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace sundog {

namespace {

constexpr std::string_view magic = "\x89SUNDOG\n";
constexpr std::uint32_t byte_order_mark = 0x01020304;
constexpr std::string_view end_name = "end";

struct SectionHeader {
    std::uint32_t name_bytes;
    std::uint32_t zero;
    std::uint64_t data_bytes;
};
static_assert(sizeof(SectionHeader) == 16);

CheckpointDigest digest_of(const Hash& hash) { return {hash.low(), hash.high()}; }

CheckpointDigest digest_of(std::string_view name, std::string_view data) { return digest_of(Hash().append_field(name).append_field(data)); }

// Elements of a piece that are held at a time.
std::size_t elements_of_a_block(std::size_t element_bytes)
{
    constexpr std::size_t block_bytes = 1 << 20;
    return std::max<std::size_t>(block_bytes / element_bytes, 1);
}

template <class T> std::string_view bytes_of(const T& value)
{
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string_view text_of(std::span<std::byte> data)
{
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}

} // namespace

CheckpointWriter::CheckpointWriter(const std::filesystem::path& file) : file_(file)
{
    file_.write(magic);
    file_.write(bytes_of(checkpoint_layout));
    file_.write(bytes_of(byte_order_mark));
}

void CheckpointWriter::section(std::string_view name, std::string_view data)
{
    file_.write(bytes_of(SectionHeader{static_cast<std::uint32_t>(name.size()), 0, data.size()}));
    file_.write(name);
    file_.write(data);
    file_.write(bytes_of(digest_of(name, data)));
}

void CheckpointWriter::bytes(std::string_view name, std::span<std::byte> data) { section(name, text_of(data)); }

void CheckpointWriter::blocks(std::string_view name, std::size_t elements, std::size_t element_bytes, const Exchange& exchange)
{
    const std::size_t at_once = elements_of_a_block(element_bytes);
    Hash hash = Hash().append_field(name).begin_field(elements * element_bytes);
    file_.write(bytes_of(SectionHeader{static_cast<std::uint32_t>(name.size()), 0, elements * element_bytes}));
    file_.write(name);
    std::vector<std::byte> block;
    for (std::size_t first = 0; first < elements; first += at_once) {
        block.resize(std::min(at_once, elements - first) * element_bytes);
        exchange(first, block);
        hash.append(text_of(block));
        file_.write(text_of(block));
    }
    file_.write(bytes_of(digest_of(hash)));
}

void CheckpointWriter::refuse(const std::string& why) const { throw FileError("cannot save: " + why); }

void CheckpointWriter::text(std::string_view name, std::string_view text) { section(name, text); }

void CheckpointWriter::commit()
{
    section(end_name, {});
    file_.commit();
}

CheckpointReader::CheckpointReader(const std::filesystem::path& file, FileUse use) : path_(file), use_(std::move(use))
{
    std::error_code error;
    if (!std::filesystem::exists(file, error)) throw FileError(fmt::format("{}: {}, there is no such file", file.string(), use_.failure));
    if (!std::filesystem::is_regular_file(file, error)) refuse("is not a file");
    check_file_readable(file);
    file_.open(file, std::ios::binary);
    left_ = std::filesystem::file_size(file, error);

    std::string start(magic.size(), '\0');
    std::uint32_t layout = 0, mark = 0;
    if (left_ < start.size() + sizeof layout + sizeof mark) refuse("is too short for a " + use_.kind);
    take(start.data(), start.size());
    if (start != magic) refuse(fmt::format("is not a {} of sundog", use_.kind));
    take(&layout, sizeof layout);
    take(&mark, sizeof mark);
    if (mark != byte_order_mark) refuse("is from a machine of another byte order, or damaged");
    if (layout != checkpoint_layout) refuse(fmt::format("has layout {}, this sundog reads layout {}", layout, checkpoint_layout));
}

void CheckpointReader::refuse(const std::string& why) const
{
    throw FileError(fmt::format("{}: {}, the file {}; {}", path_.string(), use_.failure, why, use_.cure));
}

void CheckpointReader::take(void* target, std::uint64_t bytes)
{
    if (bytes > left_) refuse("is damaged: it was cut off");
    if (!file_.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes))) refuse("cannot be read to its end");
    left_ -= bytes;
}

std::uint64_t CheckpointReader::begin_section(std::string_view name)
{
    SectionHeader header{};
    take(&header, sizeof header);
    if (header.zero != 0 || header.name_bytes > left_ || header.data_bytes > left_) refuse("is damaged or was cut off");
    std::string found(header.name_bytes, '\0');
    take(found.data(), found.size());
    if (found != name) refuse(fmt::format("is damaged or was made by another sundog: no \"{}\" where it should be", name));
    return header.data_bytes;
}

void CheckpointReader::end_section(std::string_view name, const CheckpointDigest& digest)
{
    CheckpointDigest stored{};
    take(&stored, sizeof stored);
    if (stored != digest) refuse(fmt::format("is damaged: the checksum of \"{}\" is wrong", name));
}

void CheckpointReader::expect_bytes(std::string_view name, std::uint64_t wanted)
{
    const std::uint64_t stored = begin_section(name);
    if (stored != wanted) refuse(fmt::format("is damaged or was made by another sundog: \"{}\" has {} bytes, not {}", name, stored, wanted));
}

std::uint64_t CheckpointReader::next_bytes()
{
    SectionHeader header{};
    const std::uint64_t left = left_;
    take(&header, sizeof header);
    file_.seekg(-static_cast<std::streamoff>(sizeof header), std::ios::cur);
    left_ = left;
    return header.data_bytes;
}

void CheckpointReader::blocks(std::string_view name, std::size_t elements, std::size_t element_bytes, const Exchange& exchange)
{
    expect_bytes(name, elements * element_bytes);
    const std::size_t at_once = elements_of_a_block(element_bytes);
    Hash hash = Hash().append_field(name).begin_field(elements * element_bytes);
    std::vector<std::byte> block;
    for (std::size_t first = 0; first < elements; first += at_once) {
        block.resize(std::min(at_once, elements - first) * element_bytes);
        take(block.data(), block.size());
        hash.append(text_of(block));
        exchange(first, block);
    }
    end_section(name, digest_of(hash));
}

void CheckpointReader::bytes(std::string_view name, std::span<std::byte> data)
{
    expect_bytes(name, data.size());
    take(data.data(), data.size());
    end_section(name, digest_of(name, text_of(data)));
}

std::string CheckpointReader::text(std::string_view name, std::uint64_t most_bytes)
{
    const std::uint64_t stored = begin_section(name);
    if (stored > most_bytes) refuse(fmt::format("is damaged: \"{}\" has {} bytes, more than it can have", name, stored));
    std::string text(stored, '\0');
    take(text.data(), text.size());
    end_section(name, digest_of(name, text));
    return text;
}

void CheckpointReader::finish()
{
    bytes(end_name, {});
    if (left_ > 0) refuse("is damaged: something follows its end");
}

} // namespace sundog
