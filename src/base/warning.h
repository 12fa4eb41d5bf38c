// What an importer says of a scene that it can render all the same.
#pragma once

#include "base/printable.h"

#include <ostream>
#include <string>

namespace sundog {

enum class WarningKind {
    ignored, // something in the file has no effect
    approximated, // something is rendered in another way than the file asks for
    note, // something was added, dropped or unusual, without effect on what the file asks for
};

// Reads as its text.
struct Warning {
    std::string text; // one line, "FILE:LINE: ..."
    WarningKind kind = WarningKind::note;

    Warning(std::string line, WarningKind of = WarningKind::note) : text(printable(line)), kind(of) {}
    operator const std::string&() const { return text; }
};

inline std::ostream& operator<<(std::ostream& stream, const Warning& warning) { return stream << warning.text; }

} // namespace sundog
