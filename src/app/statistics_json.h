// A render's statistics as `--stats FILE.json` holds them.
#pragma once

#include "render/session.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace sundog {

// The error that a render was to reach.
struct ErrorTarget {
    double error = 0.0;
    bool met = false;
};

// wall_seconds: from the start of the process to the written images. Parameters keep their types.
nlohmann::ordered_json statistics_json(const RenderStatistics& statistics, double wall_seconds, const std::optional<ErrorTarget>& target = {});

} // namespace sundog
