// Deflated data, read piece by piece.
#pragma once

#include "base/errors.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace sundog
{

class InflateStream
{
public:
    // `deflated` must outlive the stream; what follows the end of the deflated data in it is not looked at.
    InflateStream(std::string_view deflated, const SourceLocation& file);
    ~InflateStream();
    InflateStream(const InflateStream&) = delete;
    InflateStream& operator=(const InflateStream&) = delete;

    // Fills the buffer. Throws SceneError at `file` for damaged data, data that ends before, and data that expands to more
    // than a mesh can.
    void read(void* buffer, std::size_t size);

    // Reads on to the end of the deflated data, and so has its checksum (Adler-32) verified. Throws SceneError as read().
    void finish();

    template <class T> T value()
    {
        T v;
        read(&v, sizeof(T));
        return v;
    }

    // `count` values, of which memory for a block at a time is taken as they turn out to be there.
    template <class T> std::vector<T> values(std::size_t count)
    {
        constexpr std::size_t block = std::size_t{1} << 16;
        std::vector<T> all;
        while (all.size() < count) {
            const std::size_t done = all.size();
            all.resize(done + std::min(block, count - done));
            read(all.data() + done, (all.size() - done) * sizeof(T));
        }
        return all;
    }

private:
    int inflate_some(Bytef* target, std::size_t size, std::size_t& got); // zlib's status
    void check(int status, std::size_t got);

    z_stream stream_{};
    std::uint64_t read_ = 0; // bytes, inflated
    bool ended_ = false;
    std::size_t deflated_size_;
    std::string_view rest_; // not yet given to zlib, whose counts have 32 bits
    SourceLocation where_;
};

} // namespace sundog
