// What a render keeps from one iteration to the next, to a checkpoint and back. One function of each owner serves
// both directions, so that what is saved and what is restored cannot differ.
#pragma once

#include <cstddef>
#include <span>
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

    template <class T> void value(std::string_view name, T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(name, std::as_writable_bytes(std::span(&value, 1)));
    }
};

} // namespace sundog
