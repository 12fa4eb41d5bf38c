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

// Which files may be opened. A scene refers to regular files; the one that the user names may be standard input as well,
// by the name "-".
enum class FileKind { regular, regular_or_standard_input };

// Throws SceneError at `wanted_at`, with the path, when the file is missing, a folder, of another kind, unreadable or
// larger than 16 GiB.
std::string read_text_file(const std::filesystem::path& file, const SourceLocation& wanted_at, FileKind kind = FileKind::regular);

// The whole text as one number, blanks around it allowed. Nothing for anything else, infinities and NaN included.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

// Whether the text, which is no number to parse_number(), stands for one that is infinite, too large or none: inf, nan,
// -nan(ind), 1.#QNAN, 1e999.
bool is_not_finite(std::string_view text);

// The text after a UTF-8 byte order mark, if it begins with one. Throws SceneError at `where` for one of UTF-16 or UTF-32.
std::string_view without_byte_order_mark(std::string_view text, const SourceLocation& where);

// Splits at blanks and commas.
std::vector<std::string_view> tokens(std::string_view text);
void split(std::string_view text, std::vector<std::string_view>& list); // the same, over what was in the list

} // namespace sundog
