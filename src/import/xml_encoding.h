// Encodings of XML files.
#pragma once

#include "base/errors.h"

#include <string>

namespace sundog
{

// An XML file's text in UTF-8. What it is in is told by its byte order mark, by its first two bytes, or by its declaration
// (<?xml ... encoding="..."?>), else it is UTF-8 [XML 1.0, appendix F]. Throws SceneError, naming the encoding, for one
// that is not known here and for text that is not in it.
std::string utf8_of_xml(std::string text, const SourceLocation& where);

} // namespace sundog
