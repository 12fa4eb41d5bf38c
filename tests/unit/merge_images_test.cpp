// Renders added up: means and variances are those of all samples together.
#include "base/errors.h"
#include "film/merge_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sundog {
namespace {

using ::testing::HasSubstr;

using Samples = std::vector<std::vector<double>>; // by iteration, by value of the image

constexpr int width = 3, height = 2;
constexpr std::size_t values = 3 * width * height;

Samples random_samples(std::size_t iterations, unsigned seed)
{
    std::mt19937 random(seed);
    std::lognormal_distribution<double> distribution(0.0, 1.0);
    Samples samples(iterations, std::vector<double>(values));
    for (auto& iteration : samples)
        for (double& value : iteration) value = distribution(random);
    return samples;
}

// As a film resolves them: means, unbiased variances, and one channel that has none.
Image image_of(const Samples& samples, const std::string& seed)
{
    Image image(width, height, {"R", "G", "B", "variance.R", "variance.G", "variance.B", "depth.Z"});
    const double n = static_cast<double>(samples.size());
    for (std::size_t i = 0; i < values; i++) {
        double mean = 0.0, squares = 0.0;
        for (const auto& iteration : samples) mean += iteration[i] / n;
        for (const auto& iteration : samples) squares += (iteration[i] - mean) * (iteration[i] - mean);
        float* pixel = &image.pixels[i / 3 * 7];
        pixel[i % 3] = static_cast<float>(mean);
        pixel[3 + i % 3] = static_cast<float>(n > 1 ? squares / (n - 1) : 0.0);
        if (i % 3 == 0) pixel[6] = static_cast<float>(mean);
    }
    const std::string iterations = std::to_string(samples.size());
    image.metadata = {{"sundog:version", "0"},
                      {"sundog:method", "path"},
                      {"sundog:parameters", "max_depth=4 iterations=" + iterations + " sampler=sobol"},
                      {"sundog:scene", "abc"},
                      {"sundog:seed", seed},
                      {"sundog:iterations", iterations},
                      {"sundog:light_subpaths", "5000000000"},
                      {"sundog:camera_subpaths", "7"},
                      {"sundog:device", "some device"},
                      {"sundog:seconds", "1.500"}};
    return image;
}

void set(Image& image, const std::string& name, const std::string& value)
{
    for (auto& [key, old] : image.metadata)
        if (key == name) old = value;
}

TEST(MergeImages, moments_are_those_of_all_samples_together)
{
    // One part of a single iteration, which knows no variance of its own.
    const std::size_t counts[] = {1, 2, 40, 7};
    Samples all;
    ImageMerger merger;
    for (unsigned part = 0; part < 4; part++) {
        const Samples samples = random_samples(counts[part], part);
        all.insert(all.end(), samples.begin(), samples.end());
        merger.add(image_of(samples, std::to_string(part)), "part.exr");
    }
    const Image merged = merger.result(), expected = image_of(all, "");
    EXPECT_EQ(merged.channels, expected.channels);
    // Parts are rounded to floats, each relative to its own size: a few units of 2^-24, and for variances the
    // difference of means is squared. 2^-20 leaves room for sixteen.
    for (std::size_t i = 0; i < merged.pixels.size(); i++) EXPECT_NEAR(merged.pixels[i] / expected.pixels[i], 1.0f, 0x1p-20f) << i;
}

TEST(MergeImages, single_iterations_have_a_variance_together)
{
    ImageMerger merger;
    for (unsigned part = 0; part < 2; part++) {
        Samples samples(1, std::vector<double>(values, part == 0 ? 1.0 : 4.0));
        merger.add(image_of(samples, std::to_string(part)), "part.exr");
    }
    const Image merged = merger.result();
    EXPECT_EQ(merged.pixels[0], 2.5f);
    EXPECT_EQ(merged.pixels[3], 4.5f); // (1.5^2 + 1.5^2) / 1
    EXPECT_EQ(merged.pixels[6], 2.5f);
}

TEST(MergeImages, totals_are_summed_and_seeds_listed)
{
    ImageMerger merger;
    Image second = image_of(random_samples(3, 2), "18446744073709551615");
    set(second, "sundog:device", "another device");
    merger.add(image_of(random_samples(2, 1), "5 9"), "a.exr"); // itself merged
    merger.add(second, "b.exr");
    const auto metadata = merger.result().metadata;
    using ::testing::Pair;
    EXPECT_THAT(metadata, ::testing::IsSupersetOf({Pair("sundog:seed", "5 9 18446744073709551615"), Pair("sundog:iterations", "5"),
                                                   Pair("sundog:light_subpaths", "10000000000"), Pair("sundog:camera_subpaths", "14"),
                                                   Pair("sundog:seconds", "3.000"), Pair("sundog:device", "some device, another device"),
                                                   Pair("sundog:method", "path"), Pair("sundog:scene", "abc")}));
}

// Three renders of 4, 9 and 16 iterations, each an interval beside its own bias.
TEST(MergeImages, error_bounds_are_those_of_the_mean)
{
    const std::vector<std::string> channels{"R", "G", "B", "error.R", "error.G", "error.B", "bias.R", "bias.G", "bias.B"};
    const double counts[] = {4, 9, 16}, widths[] = {0.5, 0.25, 0.125}, biases[] = {-0.25, 0.5, 0.75};
    for (const bool biased : {true, false}) {
        SCOPED_TRACE(biased);
        ImageMerger merger;
        double bias = 0.0, squares = 0.0;
        for (std::size_t part = 0; part < 3; part++) {
            Image image(1, 1, biased ? channels : std::vector<std::string>(channels.begin(), channels.begin() + 6));
            image.metadata = image_of(random_samples(2, 1), std::to_string(part)).metadata;
            image.metadata.emplace_back("sundog:error_confidence", "0.9");
            image.metadata.emplace_back("sundog:error_bound", "7");
            set(image, "sundog:iterations", std::to_string(static_cast<int>(counts[part])));
            for (std::size_t c = 0; c < 3; c++) {
                image.pixels[c] = 2.0f;
                image.pixels[3 + c] = static_cast<float>(widths[part] + (biased ? std::abs(biases[part]) : 0.0));
                if (biased) image.pixels[6 + c] = static_cast<float>(biases[part]);
            }
            merger.add(image, "part.exr");
            bias += counts[part] / 29.0 * (biased ? biases[part] : 0.0);
            squares += std::pow(counts[part] / 29.0 * widths[part], 2);
        }
        const Image merged = merger.result();
        const double bound = std::abs(bias) + std::sqrt(squares);
        EXPECT_NEAR(merged.pixels[4], bound, 1e-6);
        if (biased) {
            EXPECT_NEAR(merged.pixels[7], bias, 1e-6);
        }
        const auto text = std::find_if(merged.metadata.begin(), merged.metadata.end(), [](const auto& m) { return m.first == "sundog:error_bound"; });
        EXPECT_NEAR(std::stod(text->second), bound / std::sqrt(4.01), 1e-5);
    }
}

// The message of adding `change`d to a part with seed 1.
template <class Change> std::string refusal(Change change)
{
    ImageMerger merger;
    merger.add(image_of(random_samples(2, 1), "1"), "a.exr");
    Image other = image_of(random_samples(3, 2), "2");
    change(other);
    try {
        merger.add(other, "b.exr");
    } catch (const FileError& error) {
        return error.what();
    }
    ADD_FAILURE() << "merged";
    return {};
}

TEST(MergeImages, parts_that_do_not_belong_together_are_refused)
{
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:seed", "1"); }),
                HasSubstr("b.exr: cannot be merged, it was rendered with seed 1, as a.exr was: the same random numbers"));
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:seed", "3 1"); }), HasSubstr("with seed 1, as a.exr was"));
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:method", "sppm"); }), HasSubstr("its method is sppm but that of a.exr is path"));
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:parameters", "max_depth=5 iterations=3 sampler=sobol"); }),
                HasSubstr("is max_depth=5 sampler=sobol but that of a.exr is max_depth=4 sampler=sobol"));
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:scene", "abd"); }), HasSubstr("another scene"));
    EXPECT_THAT(refusal([](Image& b) { b.metadata.emplace_back("sundog:error_confidence", "0.9"); }),
                HasSubstr("its error confidence is 0.9 but that of a.exr is none"));
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:iterations", "0"); }), HasSubstr("it has no iterations"));
    EXPECT_THAT(refusal([](Image& b) { set(b, "sundog:iterations", "-3"); }), HasSubstr("sundog:iterations is no number"));
    EXPECT_THAT(refusal([](Image& b) { b.metadata.clear(); }), HasSubstr("it has no metadata sundog:iterations"));
    EXPECT_THAT(refusal([](Image& b) { b.channels[6] = "depth.W"; }), HasSubstr("its list of channels is R G B variance.R variance.G variance.B depth.W"));
    EXPECT_THAT(refusal([](Image& b) { std::swap(b.width, b.height); }), HasSubstr("its size is 2x3 but that of a.exr is 3x2"));
    EXPECT_THAT(refusal([](Image& b) { b.at(2, 1, 4) = std::numeric_limits<float>::quiet_NaN(); }), HasSubstr("variance.G of pixel (2, 1) is nan"));
}

} // namespace
} // namespace sundog
