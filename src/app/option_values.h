// Values of command line options that have a form of their own. All throw UsageError.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sundog {

// Of render and info.
constexpr const char* allow_missing_help = "Render plain stand-ins for plugins that are not supported, with a warning each: grey bsdfs and textures; "
                                           "shapes, emitters and media are left out";

// {"a=1", "b=x=y"} to {a: "1", b: "x=y"}; the last of several values counts. `option` is for messages.
std::map<std::string, std::string> parse_assignments(const std::string& option, const std::vector<std::string>& texts);

// "1920x1080"; both at least 1.
std::pair<int, int> parse_size(const std::string& text);

// The whole text as a non-negative integer of 64 bits (CLI11 would wrap -5 around).
std::uint64_t parse_count(const std::string& option, const std::string& text);

// "HOST:PORT", the host a name or an address ("[::1]:14158" for IPv6), the port from 1 to 65535.
std::pair<std::string, std::string> parse_address(const std::string& option, const std::string& text);

// A size in whole megabytes (10^6 bytes), as bytes.
std::uint64_t parse_megabytes(const std::string& option, const std::string& text);

// The whole text as a finite number.
double parse_finite(const std::string& option, const std::string& text);

} // namespace sundog
