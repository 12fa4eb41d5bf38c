// Numbers as the shortest text that reads as the same bits, in any locale.
#pragma once

#include <string>

namespace sundog
{

// Read as double precision and rounded to single, as all readers here do, the text gives the same float.
std::string number_text(float value);
std::string number_text(double value);
// Three digits, for messages.
std::string rounded_text(double value);

} // namespace sundog
