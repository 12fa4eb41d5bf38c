// Renders the same scene several times with different seeds, for tests of means and errors.
#pragma once

#include "device/device.h"
#include "film/image.h"
#include "import/mitsuba_xml.h"
#include "render/session.h"
#include "support/places.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace sundog::test {

inline Device& shared_device()
{
    // Never destroyed: at exit the OpenCL driver's own statics may be gone first.
    static Device* const device = new Device(select_device(""));
    return *device;
}

inline Scene load_test_scene(const std::string& path, const std::map<std::string, std::string>& defines = {})
{
    return load_scene(source_folder() / "scenes" / path, {defines}).scene;
}

// Whether a test that compares means takes all of its samples (environment variable SUNDOG_THOROUGH_TESTS), as in the long tier.
inline bool thorough()
{
    return std::getenv("SUNDOG_THOROUGH_TESTS") != nullptr;
}

// Iterations of a render whose mean is compared. Else a quarter of them is taken: standard errors are twice as large, and so is
// the smallest fault that is found. Probabilities of a false alarm stay what they are.
inline std::uint64_t sampled(std::uint64_t iterations)
{
    return thorough() ? iterations : (iterations + 3) / 4;
}

// Factor on the largest standard error with which a test still proves something.
inline double allowed_noise()
{
    return thorough() ? 1.0 : 2.0;
}

// How one render of a test is made. Parameters as with --param.
struct RenderRequest {
    std::string method;
    std::uint64_t iterations = 1;
    std::map<std::string, std::string> parameters;
};

inline Image render(const Scene& scene, const RenderRequest& request, std::uint64_t seed)
{
    RenderSettings settings;
    settings.method = request.method;
    settings.parameters = request.parameters;
    settings.seed = seed;
    RenderSession session(scene, shared_device(), settings);
    for (std::uint64_t i = 0; i < request.iterations; i++) session.iterate();
    return session.image();
}

// Mean of R, G and B over a rectangle of pixels.
inline double window_mean(const Image& image, int x0, int y0, int x1, int y1)
{
    double sum = 0.0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) sum += (image.at(x, y, 0) + image.at(x, y, 1) + image.at(x, y, 2)) / 3.0;
    return sum / ((x1 - x0) * (y1 - y0));
}

inline double image_mean(const Image& image)
{
    return window_mean(image, 0, 0, image.width, image.height);
}

// A mean of independent replicates, and its standard error.
struct Estimate {
    double mean = 0.0;
    double standard_error = 0.0;
};

inline Estimate estimate_from(const std::vector<double>& replicates)
{
    const double n = static_cast<double>(replicates.size());
    double mean = 0.0, squares = 0.0;
    for (double x : replicates) mean += x / n;
    for (double x : replicates) squares += (x - mean) * (x - mean);
    return {mean, std::sqrt(squares / (n - 1.0) / n)};
}

// As render, with sampled iterations.
inline Image render_sampled(const Scene& scene, const RenderRequest& request, int seed)
{
    return render(scene, {request.method, sampled(request.iterations), request.parameters}, static_cast<std::uint64_t>(seed));
}

// Replicates of the image's mean, seeds 1 to `count`.
inline Estimate estimate_image_mean(const Scene& scene, const RenderRequest& request, int count)
{
    std::vector<double> means;
    for (int seed = 1; seed <= count; seed++) means.push_back(image_mean(render_sampled(scene, request, seed)));
    return estimate_from(means);
}

// The same over the image's lower half. In a Cornell box the lamp is in the upper one, and its edges are all the noise there.
inline Estimate estimate_lower_half(const Scene& scene, const RenderRequest& request, int count)
{
    std::vector<double> means;
    for (int seed = 1; seed <= count; seed++) {
        const Image image = render_sampled(scene, request, seed);
        means.push_back(window_mean(image, 0, image.height / 2, image.width, image.height));
    }
    return estimate_from(means);
}

// Root mean square deviation of green over six seeds, relative to its mean; of the rows from first_row on.
inline double relative_noise(const Scene& scene, const RenderRequest& request, int first_row = 0)
{
    constexpr int seeds = 6;
    std::vector<Image> images;
    for (std::uint64_t seed = 1; seed <= seeds; seed++) images.push_back(render(scene, request, seed));
    double variance = 0.0, mean = 0.0;
    for (int y = first_row; y < images[0].height; y++)
        for (int x = 0; x < images[0].width; x++) {
            double sum = 0.0, squares = 0.0;
            for (const Image& image : images) {
                const double value = static_cast<double>(image.at(x, y, 1));
                sum += value;
                squares += value * value;
            }
            mean += sum / seeds;
            variance += (squares - sum * sum / seeds) / (seeds - 1);
        }
    const double pixels = static_cast<double>(images[0].width) * (images[0].height - first_row);
    return std::sqrt(variance / pixels) / (mean / pixels);
}

// Quantile of Student's t distribution beyond which each tail holds `tail`, by bisection on its CDF (Simpson's rule).
inline double student_quantile(double degrees, double tail)
{
    const double norm = std::exp(std::lgamma(0.5 * (degrees + 1)) - std::lgamma(0.5 * degrees)) / std::sqrt(degrees * M_PI);
    const auto density = [&](double t) { return norm * std::pow(1.0 + t * t / degrees, -0.5 * (degrees + 1)); };
    const auto upper_tail = [&](double t) {
        constexpr int steps = 2000;
        double sum = density(0.0) + density(t);
        for (int i = 1; i < steps; i++) sum += density(t * i / steps) * (i % 2 ? 4.0 : 2.0);
        return 0.5 - sum * t / steps / 3.0;
    };
    double low = 0.0, high = 200.0;
    for (int i = 0; i < 60; i++) (upper_tail(0.5 * (low + high)) > tail ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
}

} // namespace sundog::test
