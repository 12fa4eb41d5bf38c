// Typed device memory.
#pragma once

#include "device/device.h"

#include <bit>
#include <cassert>
#include <span>
#include <type_traits>
#include <vector>

namespace sundog
{

// Untyped part: one allocation. On CPU devices the memory is 2 MB aligned, huge-page advised host
// memory that the device uses in place (up to +41% on incoherent traversal).
class RawBuffer
{
public:
    RawBuffer() = default;
    // label names the buffer in out-of-memory errors. bytes 0 is rounded up to the smallest allocation.
    RawBuffer(Device& device, std::size_t bytes, std::string label);
    RawBuffer(RawBuffer&&) noexcept;
    RawBuffer& operator=(RawBuffer&&) noexcept;
    ~RawBuffer();

    // The same memory under another label, for as long as either lives: counted once, while this one does.
    RawBuffer share(std::string label) const;

    std::size_t bytes() const { return bytes_; }
    const std::string& label() const { return label_; }
    explicit operator bool() const { return memory_ != nullptr; }

    void write(std::size_t offset, const void* source, std::size_t bytes); // returns when source may be reused
    void read(std::size_t offset, void* target, std::size_t bytes) const;  // waits for all work before it
    void fill(const void* pattern, std::size_t pattern_bytes);             // enqueues
    void* memory() const { return memory_; }                               // the cl_mem

private:
    std::shared_ptr<Device::State> device_;
    void* memory_ = nullptr;
    std::size_t bytes_ = 0;
    std::size_t allocated_ = 0;
    std::string label_;
};

// count elements of T, uninitialised unless made from data.
template <class T> class Buffer
{
    static_assert(std::is_trivially_copyable_v<T>);

public:
    using value_type = T;

    Buffer() = default;
    Buffer(Device& device, std::size_t count, std::string label) : raw_(device, count * sizeof(T), std::move(label)), size_(count) {}
    Buffer(Device& device, std::span<const T> data, std::string label) : Buffer(device, data.size(), std::move(label)) { upload(data); }
    Buffer(Device& device, const std::vector<T>& data, std::string label) : Buffer(device, std::span<const T>(data), std::move(label)) {}

    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    explicit operator bool() const { return bool(raw_); }

    void upload(std::span<const T> data, std::size_t first = 0)
    {
        assert(first + data.size() <= size_);
        if (!data.empty()) raw_.write(first * sizeof(T), data.data(), data.size_bytes());
    }
    void download_to(std::span<T> target, std::size_t first) const
    {
        assert(first + target.size() <= size_);
        if (!target.empty()) raw_.read(first * sizeof(T), target.data(), target.size_bytes());
    }
    std::vector<T> download(std::size_t first, std::size_t count) const
    {
        std::vector<T> data(count);
        download_to(data, first);
        return data;
    }
    std::vector<T> download() const { return download(0, size_); }
    T read(std::size_t index) const { return download(index, 1).front(); }
    // Sets all elements to the value; enqueues.
    void fill(T value)
    {
        static_assert(std::has_single_bit(sizeof(T)) && sizeof(T) <= 128, "OpenCL fills with patterns of 1, 2, 4 ... 128 bytes");
        raw_.fill(&value, sizeof(T));
    }
    const RawBuffer& raw() const { return raw_; }

    // The same memory as `count` elements of another type, for as long as either lives: what is written through one
    // overwrites the other's.
    template <class Other> Buffer<Other> share_as(std::size_t count, std::string label) const
    {
        assert(count * sizeof(Other) <= bytes());
        Buffer<Other> other;
        other.raw_ = raw_.share(std::move(label));
        other.size_ = count;
        return other;
    }

private:
    template <class Other> friend class Buffer;

    RawBuffer raw_;
    std::size_t size_ = 0;
};

} // namespace sundog
