// Reconstruction filters: camera paths draw offsets from them, light paths draw pixels.
#include "scene/flat_scene.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"

#include <map>

namespace sundog
{
namespace
{

constexpr int tests_in_file = 5;
constexpr uint samples = 400'000;

const std::vector<ReconstructionFilter> filters = {
    {FilterKind::box, 0.5f, 0.5f, 0.0f, 0.0f},      {FilterKind::tent, 1.0f, 0.5f, 0.0f, 0.0f},
    {FilterKind::gaussian, 2.0f, 0.5f, 0.0f, 0.0f}, {FilterKind::mitchell, 2.0f, 0.5f, 1.0f / 3.0f, 1.0f / 3.0f},
    {FilterKind::lanczos, 3.0f, 0.5f, 0.0f, 0.0f},
    {FilterKind::gaussian, 1.3f, 0.4f, 0.0f, 0.0f}, // not a whole number of pixels
};

class PixelFilters : public DeviceFixture
{
};

// Magnitudes follow |f|, weights carry the sign, and weighted offsets have the filter's moments.
TEST_F(PixelFilters, OffsetsFollowTheFilter)
{
    const Kernel kernel = test_kernel(R"(
        #include "scene/camera_rays.h"
        __kernel void test(__global const PixelFilter* filter, uint count, __global float* output)
        {
            uint i = get_global_id(0);
            if (i < count) vstore2(sample_filter(filter, random4(i, 1u).x), i, output);
        })");
    const auto output = allocate<float>(std::size_t(2) * samples);
    for (const ReconstructionFilter& description : filters) {
        const PixelFilter filter = make_pixel_filter(description);
        kernel(samples, upload(std::vector{filter}), samples, output);
        const std::vector<float> drawn = output.download();

        double absolute = 0.0;
        const double bin_width = 2.0 * filter.radius / FILTER_BINS;
        for (const float density : filter.density) absolute += std::abs(density) * bin_width;
        std::vector<double> counts(4 * FILTER_BINS, 0.0), expected(4 * FILTER_BINS, 0.0);
        for (std::size_t bin = 0; bin < expected.size(); ++bin)
            expected[bin] = std::abs(filter.density[bin / 4]) * bin_width / absolute / 4.0 * samples;
        double weights = 0.0, weights_squared = 0.0;
        for (std::size_t i = 0; i < drawn.size(); i += 2) {
            const double offset = drawn[i], weight = drawn[i + 1];
            ASSERT_LE(std::abs(offset), filter.radius);
            const auto bin = std::min(counts.size() - 1,
                                      static_cast<std::size_t>((offset / filter.radius + 1.0) * 0.5 * static_cast<double>(counts.size())));
            counts[bin] += 1.0;
            weights += weight;
            weights_squared += weight * weight;
            // On the border of two bins rounding may name the neighbour.
            if (std::abs(filter.density[bin / 4]) > 0.01f) {
                ASSERT_EQ(weight < 0.0, filter.density[bin / 4] < 0.0f) << offset;
            }
        }
        EXPECT_TRUE(follows(counts, expected, tests_in_file)) << "radius " << filter.radius;
        const double mean = weights / samples, deviation = std::sqrt(std::max(0.0, weights_squared / samples - mean * mean) / samples);
        EXPECT_NEAR(mean, 1.0, 4.0 * deviation + 1e-5) << "radius " << filter.radius;
    }
}

// For every film coordinate the mean over u of the chosen weights equals the sum of the filter's values at the
// pixels, pixel by pixel; no pixel outside of the filter is chosen.
TEST_F(PixelFilters, ChosenPixelsCarryTheFiltersWeights)
{
    const Kernel kernel = test_kernel(R"(
        #include "scene/film_splat.h"
        // u runs over the midpoints of [0, 1) for each coordinate.
        __kernel void test(__global const PixelFilter* filter, uint coordinates, uint steps, __global int* pixels, __global float* weights)
        {
            uint i = get_global_id(0);
            if (i >= coordinates * steps) return;
            float weight;
            pixels[i] = choose_filter_pixel(filter, 3.0f + ((float)(i / steps) + 0.5f) / (float)coordinates, ((float)(i % steps) + 0.5f) / (float)steps, &weight);
            weights[i] = weight;
        })");
    constexpr uint coordinates = 128, steps = 2048;
    const auto pixels = allocate<int>(coordinates * steps);
    const auto weights = allocate<float>(coordinates * steps);
    for (const ReconstructionFilter& description : filters) {
        const PixelFilter filter = make_pixel_filter(description);
        kernel(coordinates * steps, upload(std::vector{filter}), coordinates, steps, pixels, weights);
        const auto chosen = pixels.download();
        const auto weight = weights.download();
        double total = 0.0;
        for (uint coordinate = 0; coordinate < coordinates; ++coordinate) {
            const double film = 3.0 + (coordinate + 0.5) / coordinates;
            std::map<int, double> means;
            for (uint step = 0; step < steps; ++step)
                means[chosen[coordinate * steps + step]] += static_cast<double>(weight[coordinate * steps + step]) / steps;
            for (int pixel = -1; pixel <= 8; ++pixel) {
                const double offset = film - pixel - 0.5;
                const double bin = (offset / filter.radius + 1.0) * 0.5 * FILTER_BINS;
                const double value = bin >= 0.0 && bin < FILTER_BINS ? filter.density[static_cast<int>(bin)] : 0.0;
                // The sum of |weights| over the number of steps is how finely u resolves a weight.
                ASSERT_NEAR(means[pixel], value, 4.0 / steps) << "pixel " << pixel << " seen from " << film << ", radius " << filter.radius;
                means.erase(pixel);
                total += value / coordinates;
            }
            ASSERT_TRUE(means.empty());
        }
        EXPECT_NEAR(total, 1.0, 0.02) << "radius " << filter.radius; // the filter, integrated at so many coordinates
    }
}

} // namespace
} // namespace sundog
