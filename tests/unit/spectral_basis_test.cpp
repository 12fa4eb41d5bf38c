// Spectra that stand for colours, the density of wavelengths, and indices of refraction.
#include "scene/dispersion.h"
#include "scene/spectral_basis.h"
#include "scene/wavelength_sampling.h"
#include "support/chi_squared.h"

#include <gtest/gtest.h>

using namespace sundog;

namespace {

constexpr int steps = 940;
constexpr double step = (longest_wavelength - shortest_wavelength) / steps;

double midpoint(int i)
{
    return shortest_wavelength + (i + 0.5) * step;
}

TEST(SpectralBasis, IsPositiveAndSumsToOne)
{
    for (int i = 0; i < steps; i++) {
        const Double3 basis = reflectance_basis(midpoint(i));
        EXPECT_NEAR(basis[0] + basis[1] + basis[2], 1.0, 1e-12);
        for (double value : basis) EXPECT_GE(value, 0.0);
    }
}

// cie_1931 is a float.
TEST(SpectralBasis, HasThePrimariesUnderD65)
{
    for (std::size_t primary = 0; primary < 3; primary++) {
        Double3 rgb{};
        for (int i = 0; i < steps; i++) {
            const Double3 matching = rgb_matching(midpoint(i));
            const double light = d65(midpoint(i)) * reflectance_basis(midpoint(i))[primary] * step;
            for (std::size_t c = 0; c < 3; c++) rgb[c] += matching[c] * light;
        }
        for (std::size_t c = 0; c < 3; c++) EXPECT_NEAR(rgb[c], c == primary ? 1.0 : 0.0, 2e-6) << primary << ' ' << c;
    }
}

TEST(WavelengthSampling, DensityIntegratesToOneAndSharesInvertIt)
{
    double share = 0.0;
    for (int nanometre = 360; nanometre < 830; nanometre++) {
        share += wavelength_density(nanometre + 0.5);
        if (share > 1.0 - 1e-9) continue;
        EXPECT_NEAR(wavelength_at(share), nanometre + 1.0, 1e-3 + 1e-12 / wavelength_density(nanometre + 0.5));
    }
    EXPECT_NEAR(share, 1.0, 1e-9);
    EXPECT_EQ(wavelength_density(359.9), 0.0);
    EXPECT_EQ(wavelength_density(830.0), 0.0);
}

// Over seeds each wavelength of the three is independent and uniform in its third of the density: any bins of equal
// shares are hit equally often.
TEST(WavelengthSampling, ChiSquaredOfTheDensity)
{
    constexpr std::size_t bins = 60; // a multiple of 3: each wavelength keeps to its own 20
    std::vector<double> upper_ends;
    for (std::size_t b = 1; b < bins; b++) upper_ends.push_back(wavelength_at(static_cast<double>(b) / bins));
    for (std::size_t k = 0; k < 3; k++) {
        std::vector<double> counts(bins / 3, 0.0);
        for (std::uint64_t seed = 0; seed < 20'000; seed++) {
            const double wavelength = pass_wavelengths(seed, seed % 7)[k];
            const auto bin = static_cast<std::size_t>(std::upper_bound(upper_ends.begin(), upper_ends.end(), wavelength) - upper_ends.begin());
            ASSERT_GE(bin, k * bins / 3);
            ASSERT_LT(bin, (k + 1) * bins / 3);
            counts[bin - k * bins / 3] += 1.0;
        }
        EXPECT_TRUE(is_uniform(counts, 3)) << k;
    }
}

// For n = F_k of Fibonacci's numbers the golden ratio is F_{k+1} / F_k + d with |d| < 1 / (2 n^2). As F_{k+1} and n have no
// common divisor, the first n of its multiples are j / n, for every j once, shifted by the start (less than 1 / n) and by
// less than 1 / (2 n), all to one side. At most one of them wraps around 1, so the i-th in order is within 2 / n of i / n.
TEST(WavelengthSampling, PassesAreSpreadEvenly)
{
    for (const std::uint64_t n : {13u, 55u, 233u}) {
        std::vector<double> middle;
        for (std::uint64_t pass = 0; pass < n; pass++) middle.push_back(pass_wavelengths(7, pass)[1]);
        std::sort(middle.begin(), middle.end());
        for (std::uint64_t i = 0; i < n; i++) {
            const double place = static_cast<double>(i), count = static_cast<double>(n);
            EXPECT_GE(middle[i], wavelength_at((1.0 + std::max(0.0, (place - 2.0) / count)) / 3.0)) << n;
            EXPECT_LE(middle[i], wavelength_at((1.0 + std::min(1.0, (place + 2.0) / count)) / 3.0)) << n;
        }
    }
}

// The mean over passes of what white and the primaries become on the film is what they are: that is the estimator's
// normalisation. The tolerance is that of a sum over n points of the golden ratio.
TEST(WavelengthSampling, FilmSamplesAverageToTheColour)
{
    constexpr std::uint64_t passes = 20'000;
    double sum[3][3] = {};
    for (std::uint64_t pass = 0; pass < passes; pass++) {
        const Wavelengths w = make_wavelengths(pass_wavelengths(3, pass));
        for (int c = 0; c < 3; c++)
            for (int primary = 0; primary < 3; primary++)
                for (int k = 0; k < 3; k++)
                    sum[c][primary] += static_cast<double>(component(w.to_rgb[c], k)) * static_cast<double>(component(w.emission[k], primary));
    }
    for (int c = 0; c < 3; c++)
        for (int primary = 0; primary < 3; primary++) EXPECT_NEAR(sum[c][primary] / passes, c == primary ? 1.0 : 0.0, 1e-3) << c << ' ' << primary;
}

// Published indices: Schott's data sheets at the d line (587.6 nm); [Hecht 2002] for the sodium line of diamond and
// sapphire; the IAPWS formulation for water at 20 degrees.
TEST(Dispersion, IndicesArePublishedOnes)
{
    const auto index = [](const char* name, double micrometres) { return index_at(find_dispersion(name).value(), micrometres); };
    EXPECT_NEAR(index("BK7", 0.5875618), 1.51680, 1e-5);
    EXPECT_NEAR(index("bk7", 0.4861327), 1.52238, 1e-5);
    EXPECT_NEAR(index("sf11", 0.5875618), 1.78472, 1e-5);
    EXPECT_NEAR(index("sf11", 0.6562725), 1.77596, 2e-5);
    EXPECT_NEAR(index("fused silica", 0.5875618), 1.45846, 1e-5);
    EXPECT_NEAR(index("sapphire", 0.5893), 1.7682, 2e-4);
    EXPECT_NEAR(index("diamond", 0.5893), 2.417, 1e-3);
    EXPECT_NEAR(index("water", 0.5893), 1.3334, 1e-4);
    EXPECT_FALSE(find_dispersion("butter"));
}

} // namespace
