// `sundog bench`: sections, each of which measures some figures on a device.
#pragma once

#include "device/device.h"

#include <optional>
#include <string>
#include <vector>

namespace sundog {

struct BenchFigure {
    std::string section;
    std::string name;
    std::string unit;
    double value = 0.0;
    std::optional<double> target; // what the value should reach
    bool at_most = false; // the target bounds the value from above instead of from below

    bool met() const { return !target || (at_most ? value <= *target : value >= *target); }
};

struct BenchSection {
    std::string name;
    std::string description;
    std::vector<BenchFigure> (*run)(Device& device);
};

// In the order in which they run. To add a section: write its function, add it to the list in bench.cpp.
const std::vector<BenchSection>& bench_sections();

} // namespace sundog
