#include "support/places.h"

namespace sundog::test {

std::filesystem::path source_folder() { return SUNDOG_SOURCE_DIR; }
std::filesystem::path sundog_executable() { return SUNDOG_EXECUTABLE; }

} // namespace sundog::test
