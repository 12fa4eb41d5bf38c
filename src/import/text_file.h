// Whole files as text, and numbers in text: strict, finite and independent of the locale.
#pragma once

#include "base/errors.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sundog
{

// Which files may be opened: what a scene refers to is a regular file, so that a stranger's scene cannot read a terminal,
// wait for a pipe or drain a device without end. The file that the user names may be a pipe as well.
enum class FileKind { regular, regular_or_stream };

// Throws SceneError at `wanted_at`, with the path, when the file is missing, a folder, of another kind, unreadable or
// larger than 16 GiB.
std::string read_text_file(const std::filesystem::path& file, const SourceLocation& wanted_at, FileKind kind = FileKind::regular);

// The whole text as one number, blanks around it allowed. Nothing for anything else, infinities and NaN included.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

// Splits at blanks and commas.
std::vector<std::string_view> tokens(std::string_view text);
void split(std::string_view text, std::vector<std::string_view>& list); // the same, over what was in the list

} // namespace sundog
