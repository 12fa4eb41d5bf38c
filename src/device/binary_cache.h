// Program binaries on disk: one file a key, each with its length and fingerprint, safe under concurrent processes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sundog
{

// The binary stored under the key, or nothing when there is none, or it is damaged, or cannot be read.
std::optional<std::string> load_cached_binary(const std::string& key);

// Writes beside and renames, so that readers see all or nothing. The first failure is a warning, and the render goes on without.
void store_cached_binary(const std::string& key, std::string_view binary);

// Forgets the key's binary: the driver refused it.
void remove_cached_binary(const std::string& key);

} // namespace sundog
