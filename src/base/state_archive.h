// What a render keeps from one iteration to the next, to a checkpoint and back. One function of each owner serves
// both directions, so that what is saved and what is restored cannot differ.
//
// What comes from a file may be anything: its owner checks it against the render, and refuses what no render leaves behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace sundog {

class StateArchive {
public:
    virtual ~StateArchive() = default;

    // true: values come from the archive; false: they go there.
    virtual bool loading() const = 0;

    // One named piece of state. A loading archive gives the pieces back in the order in which they were saved and
    // throws FileError when name or size is not that of the next one.
    virtual void bytes(std::string_view name, std::span<std::byte> data) = 0;

    // The same for a piece that lies elsewhere, some of its elements at a time and in order: `exchange` fills the span, or
    // takes it where the archive is loading.
    using Exchange = std::function<void(std::size_t first_element, std::span<std::byte> data)>;
    virtual void blocks(std::string_view name, std::size_t elements, std::size_t element_bytes, const Exchange& exchange) = 0;

    // Bytes of the piece that is loaded next, whatever its name.
    virtual std::uint64_t next_bytes() = 0;

    // Throws FileError: what was loaded cannot be of this render.
    [[noreturn]] virtual void refuse(const std::string& why) const = 0;

    // Whether it takes pieces of any size, or values alone.
    virtual bool takes_blocks() const { return true; }

    template <class T> void value(std::string_view name, T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(name, std::as_writable_bytes(std::span(&value, 1)));
    }

    // A number of things that have been counted. One below 2^62 can be added to and multiplied by 2 without wrapping around.
    void count(std::string_view name, std::uint64_t& number)
    {
        value(name, number);
        check(number < std::uint64_t(1) << 62, name);
    }

    // The size of something that only grows, and by less than 65536 times: `bytes` each.
    void capacity(std::string_view name, std::uint64_t& number, std::size_t bytes, std::uint64_t most_bytes)
    {
        if (!takes_blocks()) return; // room stays
        const std::uint64_t least = number;
        value(name, number);
        check(number >= least && number >> 16 <= least && number < std::uint64_t(1) << 32 && number * bytes <= most_bytes, name);
    }

    // Of what was loaded: refuses it unless it is right.
    void check(bool is_right, std::string_view name) const
    {
        if (loading() && !is_right) refuse("is damaged: \"" + std::string(name) + "\" cannot be of this render");
    }
};

} // namespace sundog
