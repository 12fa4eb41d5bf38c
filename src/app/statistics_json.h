// A render's statistics as `--stats FILE.json` holds them.
#pragma once

#include "render/session.h"

#include <nlohmann/json.hpp>

namespace sundog {

// wall_seconds: from the start of the process to the written images. Parameters keep their types.
nlohmann::ordered_json statistics_json(const RenderStatistics& statistics, double wall_seconds);

} // namespace sundog
