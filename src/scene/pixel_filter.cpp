#include "scene/flat_scene.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace sundog {

namespace {

// Value at x pixels from the centre, not normalised.
double evaluate(const ReconstructionFilter& filter, double x)
{
    const double radius = filter.radius;
    const double a = std::abs(x);
    if (a > radius) return 0.0;
    switch (filter.kind) {
    case FilterKind::box: return 1.0;
    case FilterKind::tent: return 1.0 - a / radius;
    case FilterKind::gaussian: {
        // Lowered so that it ends at zero, as in Mitsuba.
        const double alpha = -1.0 / (2.0 * static_cast<double>(filter.stddev) * filter.stddev);
        return std::max(0.0, std::exp(alpha * x * x) - std::exp(alpha * radius * radius));
    }
    case FilterKind::mitchell: {
        // [Mitchell and Netravali 1988], stretched to the radius.
        const double t = 2.0 * a / radius;
        const double b = filter.b, c = filter.c;
        if (t < 1.0) return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) / 6.0;
        return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t + (8 * b + 24 * c)) / 6.0;
    }
    case FilterKind::lanczos: { // sinc x in the window of a sinc of the radius [Duchon 1979]
        if (a < 1e-6) return 1.0;
        const double t = std::numbers::pi * a;
        return std::sin(t) / t * std::sin(t / radius) / (t / radius);
    }
    }
    return 0.0;
}

} // namespace

PixelFilter make_pixel_filter(const ReconstructionFilter& filter)
{
    constexpr int subdivisions = 16;
    PixelFilter table{};
    table.radius = filter.radius;
    const double bin_width = 2.0 * filter.radius / FILTER_BINS;
    double bins[FILTER_BINS];
    for (int i = 0; i < FILTER_BINS; i++) {
        bins[i] = 0.0;
        for (int j = 0; j < subdivisions; j++) bins[i] += evaluate(filter, -filter.radius + (i + (j + 0.5) / subdivisions) * bin_width) / subdivisions;
    }
    const double integral = std::accumulate(bins, bins + FILTER_BINS, 0.0) * bin_width;
    const double absolute = std::accumulate(bins, bins + FILTER_BINS, 0.0, [](double sum, double f) { return sum + std::abs(f); }) * bin_width;
    double cdf = 0.0;
    for (int i = 0; i < FILTER_BINS; i++) {
        cdf += std::abs(bins[i]) * bin_width / absolute;
        table.cdf[i + 1] = static_cast<float>(cdf);
        table.sign_scale[i] = static_cast<float>((bins[i] < 0 ? -1.0 : 1.0) * absolute / integral);
        table.density[i] = static_cast<float>(bins[i] / integral);
    }
    table.cdf[FILTER_BINS] = 1.0f;
    return table;
}

} // namespace sundog
