// How far an image may be from the truth: bias and variance of every pixel, and bounds at a confidence
// [Hachisuka, Jarosz and Jensen 2010, ACM TOG 29(6)]. docs/errors.md has the mathematics.
#pragma once

#include "base/state_archive.h"
#include "device/kernel.h"
#include "film/image.h"
#include "shared/error_estimate.h"
#include "shared/film.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sundog
{

// Squared errors e^2 / (L^2 + 0.01) as in `relmse` (film/compare.h); here the root of their mean over pixels and R, G, B.
struct RelativeError {
    double bound = 0.0;      // of what each channel's error exceeds with probability 1 - confidence at most
    double bias = 0.0;       // as estimated
    double noise = 0.0;      // one standard error
    double expected() const; // sqrt(bias^2 + noise^2)
};

class ErrorEstimate
{
public:
    // biased: methods add to `bias` before each iteration is accumulated. confidence: of bounds, in (0, 1).
    ErrorEstimate(Device& device, std::size_t pixels, bool biased, double confidence);

    Buffer<Vec3> bias; // of the iteration under way (W/m^2/sr), by path; empty where there is none

    // After the film took the iteration's radiance.
    void accumulate(const Buffer<Vec3>& radiance);

    // Of the film's means over n iterations; waits. Bounds of fewer than two iterations are infinite.
    RelativeError relative_error(const Buffer<FilmPixel>& film, std::uint64_t n) const;

    // "error.R", ... and, for biased methods, "bias.R", ...; values of the film's pixels from `first` on, in path order, one
    // after another.
    std::vector<std::string> channel_names() const;
    std::vector<float> channels(const std::vector<FilmPixel>& film, std::size_t first, std::uint64_t n) const;

    double confidence() const { return confidence_; }
    bool biased() const { return bool(bias); }
    void serialize(StateArchive& archive);

private:
    double quantile(std::uint64_t n) const; // standard errors that a bound is wide

    double confidence_;
    Kernel accumulate_corrected_;
    Kernel sum_error_bounds_;
    Buffer<FilmPixel> corrected_; // sums of radiance - bias
    Buffer<RelativeSquares> sums_;
};

// Of an image with error channels: every pixel's relative bound, the root of the mean over its channels, row by row.
std::vector<double> relative_bounds(const Image& image);
// The root of the mean of their squares.
double relative_bound(const Image& image);

} // namespace sundog
