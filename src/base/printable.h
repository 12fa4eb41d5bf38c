// Text from files and command lines made fit for one line of a terminal.
#pragma once

#include <string>
#include <string_view>

namespace sundog
{

// Control characters, those of UTF-8's second block too, as \n, \t or \x1b; all else as it is. So a name in a message can
// neither begin a line of its own nor command the terminal. What is printable already stays the same.
std::string printable(std::string_view text);

// The same for a message of several lines, which stay lines.
std::string printable_lines(std::string_view text);

} // namespace sundog
