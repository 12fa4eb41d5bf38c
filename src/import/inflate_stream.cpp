#include "import/inflate_stream.h"

#include <new>

namespace sundog
{

namespace
{

constexpr std::size_t largest_piece = std::size_t{1} << 30; // bytes, within zlib's counts

} // namespace

InflateStream::InflateStream(std::string_view deflated, const SourceLocation& file) : rest_(deflated), where_(file)
{
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
}

InflateStream::~InflateStream()
{
    inflateEnd(&stream_);
}

void InflateStream::read(void* buffer, std::size_t size)
{
    auto* target = static_cast<Bytef*>(buffer);
    while (size > 0) {
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
        const std::size_t got = wanted - stream_.avail_out;
        target += got;
        size -= got;
        if (size == 0) return;
        if (status == Z_MEM_ERROR) throw std::bad_alloc();
        const bool out_of_input = stream_.avail_in == 0 && rest_.empty() && got == 0;
        if (status == Z_STREAM_END || out_of_input) throw SceneError(where_, "the mesh ends early: is the file truncated?");
        if (status != Z_OK && status != Z_BUF_ERROR)
            throw SceneError(where_,
                             std::string("the compressed mesh is damaged") + (stream_.msg ? std::string(" (") + stream_.msg + ")" : ""));
    }
}

} // namespace sundog
