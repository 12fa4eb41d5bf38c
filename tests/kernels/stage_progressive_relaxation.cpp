// Progressive photon relaxation: whose flux a primal photon takes up, against plain C++; that none is lost; and what it is
// for, noise that falls with the passes where light is even, and edges that hold.
#include "stages/progressive_relaxation.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"
#include "support/power_spectrum.h"

#include <numbers>

namespace sundog
{
namespace
{

class ProgressiveRelaxationTest : public DeviceFixture
{
protected:
    static constexpr float largest = 0.2f;

    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    // One pass of even light on the square |x|, |y| < 1, or on the part of it where x is below an edge.
    std::vector<Photon> pass_of(std::size_t count, float edge = 1.0f)
    {
        std::vector<Photon> photons;
        for (std::size_t i = 0; i < count; i++) photons.push_back(make_test_photon({uniform(-1, edge), uniform(-1, 1), 0}, {1, 2, 3}));
        return photons;
    }

    std::mt19937 random_{11};
};

double total(const std::vector<Photon>& photons)
{
    double sum = 0.0;
    for (const Photon& photon : photons) sum += photon.flux.x;
    return sum;
}

// Of the flux within r of places at least `margin` from the square's sides, relative to its mean: the mean over the true one,
// and the standard deviation.
struct Irradiance {
    double mean = 0.0, noise = 0.0;
};

Irradiance irradiance_of(const std::vector<Photon>& photons, double r, double truth, std::mt19937& random, double margin = 0.2)
{
    std::uniform_real_distribution<double> place(-1.0 + margin, 1.0 - margin);
    constexpr int places = 1500;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < places; i++) {
        const double x = place(random), y = place(random);
        double flux = 0.0;
        for (const Photon& photon : photons) {
            const double dx = photon.position.x - x, dy = photon.position.y - y, t2 = (dx * dx + dy * dy) / (r * r);
            if (t2 < 1.0) flux += photon.flux.x * 2.0 * (1.0 - t2) / (std::numbers::pi * r * r); // Epanechnikov's kernel
        }
        sum += flux;
        squares += flux * flux;
    }
    const double mean = sum / places;
    return {mean / truth, std::sqrt(squares / places - mean * mean) / truth};
}

TEST_F(ProgressiveRelaxationTest, TheNearestPrimalPhotonTakesUpTheFlux)
{
    const std::vector<Photon> primal = pass_of(400), fresh = pass_of(300);
    ProgressiveRelaxation progressive(device_, largest, -1.0f);
    progressive.add_pass(primal);
    const std::vector<Photon> before = progressive.photons();
    std::vector<double> expected(before.size());
    for (std::size_t i = 0; i < before.size(); i++) expected[i] = 0.5 * before[i].flux.y;
    for (const Photon& photon : fresh) {
        std::size_t nearest = 0;
        double least = 10.0;
        for (std::size_t i = 0; i < before.size(); i++) {
            const double d = length(Vec3d(before[i].position) - Vec3d(photon.position));
            if (d < least) {
                least = d;
                nearest = i;
            }
        }
        expected[nearest] += 0.5 * photon.flux.y;
    }
    progressive.add_pass(fresh);
    ASSERT_EQ(progressive.photons().size(), before.size());
    int differing = 0; // where two are as near as rounding can tell
    for (std::size_t i = 0; i < before.size(); i++) differing += std::abs(progressive.photons()[i].flux.y - expected[i]) > 1e-5;
    EXPECT_LE(differing, 2);
}

TEST_F(ProgressiveRelaxationTest, FluxIsThatOfThePasses)
{
    ProgressiveRelaxation progressive(device_, largest, -1.0f);
    double emitted = 0.0;
    for (int pass = 0; pass < 10; pass++) {
        std::vector<Photon> photons = pass_of(700 + 40 * static_cast<std::size_t>(pass));
        for (Photon& photon : photons) photon.flux.x = uniform(0.1f, 10.0f);
        photons.push_back(make_test_photon({uniform(-1, 1), uniform(-1, 1), 3}, {5, 5, 5})); // where there is no other
        emitted += total(photons);
        progressive.add_pass(photons);
    }
    // Of ten alone above the square, those that are near others join them.
    EXPECT_GT(progressive.photons().size(), 704u);
    EXPECT_LE(progressive.photons().size(), 710u);
    EXPECT_NEAR(total(progressive.photons()), emitted / 10.0, 1e-6 * emitted / 10.0);
}

// A primal photon faces the other way, one flies another way, one came by another kind of path: none of them is the nearest.
TEST_F(ProgressiveRelaxationTest, WhatDiffersBecomesPrimal)
{
    ProgressiveRelaxation progressive(device_, largest, 0.95f);
    Photon photon = make_test_photon({0, 0, 0}, {1, 1, 1});
    photon.direction = 0x80008000u;
    progressive.add_pass({photon});
    Photon below = make_test_photon({0.01f, 0, 0}, {1, 1, 1}, {0, 0, -1}), across = photon, marked = photon, same = photon;
    below.direction = photon.direction;
    across.direction = 0xc0008000u;
    marked.normal_depth |= PHOTON_UNREACHED;
    same.position.x = 0.05f;
    progressive.add_pass({below, across, marked, same});
    ASSERT_EQ(progressive.photons().size(), 4u);
    EXPECT_EQ(progressive.photons()[0].flux.x, 1.0f);
    for (std::size_t i = 1; i < 4; i++) EXPECT_EQ(progressive.photons()[i].flux.x, 0.5f);
}

// Of photons within the margin, so that the border does not count: their deviation relative to the mean.
double deviation_of_flux(const std::vector<Photon>& photons)
{
    double n = 0.0, sum = 0.0, squares = 0.0;
    for (const Photon& photon : photons) {
        if (std::abs(photon.position.x) > 0.8f || std::abs(photon.position.y) > 0.8f) continue;
        n += 1.0;
        sum += photon.flux.x;
        squares += static_cast<double>(photon.flux.x) * photon.flux.x;
    }
    return std::sqrt(squares / n - sum / n * (sum / n)) / (sum / n);
}

// Photons that stayed where chance has put them would have cells that differ by .53 in area, and so in flux, for ever; and their
// noise would never fall below .08.
TEST_F(ProgressiveRelaxationTest, NoiseFallsWithThePasses)
{
    constexpr std::size_t count = 4000;
    const double r = std::sqrt(20.0 * 4.0 / (count * std::numbers::pi)), truth = count / 4.0; // 20 photons in the mean
    ProgressiveRelaxation progressive(device_, largest, -1.0f);
    progressive.add_pass(pass_of(count));
    const Irradiance one = irradiance_of(progressive.photons(), r, truth, random_);
    for (int pass = 1; pass < 32; pass++) progressive.add_pass(pass_of(count));
    const Irradiance all = irradiance_of(progressive.photons(), r, truth, random_);
    EXPECT_LT(all.noise, 0.31 * one.noise);
    EXPECT_NEAR(all.mean, 1.0, 0.01); // a standard error of 32 passes of 2560 photons is 0.0035
    EXPECT_LT(deviation_of_flux(progressive.photons()), 0.4);
    EXPECT_EQ(progressive.photons().size(), count);
    for (const Photon& photon : progressive.photons()) ASSERT_NEAR(photon.position.z, 0.0f, 1e-4f);
}

TEST_F(ProgressiveRelaxationTest, EdgesStay)
{
    constexpr std::size_t count = 4000;
    ProgressiveRelaxation progressive(device_, largest, -1.0f);
    for (int pass = 0; pass < 16; pass++) progressive.add_pass(pass_of(count, 0.0f));
    const double spacing = std::sqrt(2.0 / count);
    double beyond = 0.0;
    for (const Photon& photon : progressive.photons())
        if (photon.position.x > spacing) beyond += photon.flux.x;
    EXPECT_LT(beyond, 0.1 * spacing * count) << "a tenth of what lies within a spacing of the edge";
}

// A sphere: photons that move along tangents, ever less, do not leave it.
TEST_F(ProgressiveRelaxationTest, PhotonsStayOnCurvedSurfaces)
{
    ProgressiveRelaxation progressive(device_, largest, -1.0f);
    for (int pass = 0; pass < 20; pass++) {
        std::vector<Photon> photons;
        while (photons.size() < 1000) {
            const Vec3d p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (length(p) > 1.0 || length(p) < 0.1) continue;
            const Vec3d n = normalized(p);
            photons.push_back(make_test_photon({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}, {1, 1, 1}, n));
        }
        progressive.add_pass(photons);
    }
    double worst = 0.0;
    for (const Photon& photon : progressive.photons()) worst = std::max(worst, std::abs(length(Vec3d(photon.position)) - 1.0));
    EXPECT_LT(worst, 0.01) << "of cells 0.11 wide, in a lookup that is some cells wide";
}

} // namespace
} // namespace sundog
