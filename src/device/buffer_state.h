// A device buffer as part of a render's state.
#pragma once

#include "base/state_archive.h"
#include "device/buffer.h"

namespace sundog {

// Saves or restores all elements; waits for the device.
template <class T> void serialize(StateArchive& archive, std::string_view name, Buffer<T>& buffer)
{
    std::vector<T> elements = archive.loading() ? std::vector<T>(buffer.size()) : buffer.download();
    archive.bytes(name, std::as_writable_bytes(std::span(elements)));
    if (archive.loading()) buffer.upload(std::span<const T>(elements));
}

} // namespace sundog
