// A device buffer as part of a render's state.
#pragma once

#include "base/state_archive.h"
#include "device/buffer.h"

namespace sundog {

// Saves or restores all elements, a block at a time; waits for the device. `is_right` tells of an element that was read
// whether a render can have left it: what is not is refused.
template <class T, class IsRight> void serialize(StateArchive& archive, std::string_view name, Buffer<T>& buffer, const IsRight& is_right)
{
    archive.blocks(name, buffer.size(), sizeof(T), [&](std::size_t first, std::span<std::byte> data) {
        const std::span<T> elements(reinterpret_cast<T*>(data.data()), data.size() / sizeof(T));
        if (!archive.loading()) return buffer.download_to(elements, first);
        for (const T& element : elements) archive.check(is_right(element), name);
        buffer.upload(elements, first);
    });
}

// For elements of which all bits are right.
template <class T> void serialize(StateArchive& archive, std::string_view name, Buffer<T>& buffer)
{
    serialize(archive, name, buffer, [](const T&) { return true; });
}

} // namespace sundog
