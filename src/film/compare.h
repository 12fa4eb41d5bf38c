// How far an image is from a reference.
#pragma once

#include "film/image.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace sundog {

// Over the R, G, B channels of all pixels; a: image, b: reference. In double precision.
struct ImageDifference {
    double mse = 0.0; // mean (a - b)^2
    double rmse = 0.0; // sqrt(mse)
    double relmse = 0.0; // mean (a - b)^2 / (b^2 + 0.01)
    double mae = 0.0; // mean |a - b|
    double mean_ratio = 1.0; // mean a / mean b; 1 when both are 0

    // Name and value in the order above.
    std::array<std::pair<const char*, double>, 5> all() const;
    std::optional<double> find(const std::string& metric) const; // nullopt: no such metric
};

// Throws FileError, with the files' names, when the sizes differ, an image has no colour, or a value is NaN or infinite.
ImageDifference compare_images(const Image& image, const Image& reference, const std::filesystem::path& image_file = "image",
                               const std::filesystem::path& reference_file = "reference");

// The same of two files, which are read row by row. Throws FileError also for what cannot be read.
ImageDifference compare_files(const std::filesystem::path& image_file, const std::filesystem::path& reference_file);

} // namespace sundog
