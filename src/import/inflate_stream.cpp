#include "import/inflate_stream.h"

#include <array>
#include <new>

namespace sundog
{

namespace
{

constexpr std::size_t largest_piece = std::size_t{1} << 30; // bytes, within zlib's counts
// A flat grid of floats shrinks to a fiftieth or so; deflated zeros, to a thousandth.
constexpr std::uint64_t largest_expansion = 250;
constexpr std::uint64_t always_read = std::uint64_t{1} << 26; // bytes

} // namespace

InflateStream::InflateStream(std::string_view deflated, const SourceLocation& file)
    : deflated_size_(deflated.size()), rest_(deflated), where_(file)
{
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
}

InflateStream::~InflateStream()
{
    inflateEnd(&stream_);
}

int InflateStream::inflate_some(Bytef* target, std::size_t size, std::size_t& got)
{
    if (stream_.avail_in == 0) {
        const std::size_t piece = std::min(rest_.size(), largest_piece);
        // zlib only reads through the pointer, which its interface does not say.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
        stream_.avail_in = static_cast<uInt>(piece);
        rest_.remove_prefix(piece);
    }
    const std::size_t wanted = std::min(size, largest_piece);
    stream_.next_out = target;
    stream_.avail_out = static_cast<uInt>(wanted);
    const int status = inflate(&stream_, Z_SYNC_FLUSH);
    got = wanted - stream_.avail_out;
    read_ += got;
    if (read_ > always_read && read_ / largest_expansion > deflated_size_)
        throw SceneError(where_, "the compressed mesh expands to more than " + std::to_string(largest_expansion) +
                                     " times its size, which no mesh does: is the file damaged?");
    return status;
}

void InflateStream::check(int status, std::size_t got)
{
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    const bool out_of_input = stream_.avail_in == 0 && rest_.empty() && got == 0;
    if (out_of_input && status != Z_DATA_ERROR) throw SceneError(where_, "the mesh ends early: is the file truncated?");
    if (status != Z_OK && status != Z_BUF_ERROR)
        throw SceneError(where_,
                         std::string("the compressed mesh is damaged") + (stream_.msg ? std::string(" (") + stream_.msg + ")" : ""));
}

void InflateStream::read(void* buffer, std::size_t size)
{
    auto* target = static_cast<Bytef*>(buffer);
    while (size > 0) {
        std::size_t got = 0;
        const int status = inflate_some(target, size, got);
        target += got;
        size -= got;
        ended_ = status == Z_STREAM_END;
        if (size == 0) return;
        if (ended_) throw SceneError(where_, "the mesh ends early: is the file truncated?");
        check(status, got);
    }
}

void InflateStream::finish()
{
    std::array<Bytef, 4096> unused;
    while (!ended_) {
        std::size_t got = 0;
        const int status = inflate_some(unused.data(), unused.size(), got);
        ended_ = status == Z_STREAM_END;
        if (!ended_) check(status, got);
    }
}

} // namespace sundog
