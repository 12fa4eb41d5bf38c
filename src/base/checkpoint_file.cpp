#include "base/checkpoint_file.h"

#include "base/errors.h"
#include "base/hash.h"

#include <fmt/format.h>

#include <algorithm>

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

struct Digest {
    std::uint64_t low, high;
    bool operator==(const Digest&) const = default;
};

Digest digest_of(std::string_view name, std::string_view data)
{
    const Hash hash = Hash().append_field(name).append_field(data);
    return {hash.low(), hash.high()};
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
    file_.open(file, std::ios::binary);
    if (!file_) throw FileError(file.string() + ": cannot read; check its permissions");
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

void CheckpointReader::end_section(std::string_view name, std::string_view data)
{
    Digest stored{};
    take(&stored, sizeof stored);
    if (stored != digest_of(name, data)) refuse(fmt::format("is damaged: the checksum of \"{}\" is wrong", name));
}

void CheckpointReader::bytes(std::string_view name, std::span<std::byte> data)
{
    const std::uint64_t stored = begin_section(name);
    if (stored != data.size()) refuse(fmt::format("is damaged or was made by another sundog: \"{}\" has {} bytes, not {}", name, stored, data.size()));
    take(data.data(), stored);
    end_section(name, text_of(data));
}

std::string CheckpointReader::text(std::string_view name)
{
    std::string text(begin_section(name), '\0');
    take(text.data(), text.size());
    end_section(name, text);
    return text;
}

void CheckpointReader::finish()
{
    bytes(end_name, {});
    if (left_ > 0) refuse("is damaged: something follows its end");
}

} // namespace sundog
