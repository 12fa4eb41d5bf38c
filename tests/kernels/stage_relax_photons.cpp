// Photon relaxation: a sweep against plain C++; and what it is for, less noise of small estimates with the same flux in the
// same places.
#include "stages/photon_relaxation.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"
#include "support/power_spectrum.h"

#include <numbers>

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr std::size_t neighbours = 32; // as src/stages/photon_relaxation.cpp says

class RelaxPhotons : public DeviceFixture
{
protected:
    std::vector<Photon> relaxed(std::vector<Photon> photons, int sweeps, float least_cosine = -1.0f)
    {
        PhotonRelaxation(device_, 1.0f, least_cosine).relax(photons, sweeps);
        return photons;
    }

    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    // Even light on the square |x|, |y| < 1, or on the part of it where x is below an edge.
    std::vector<Photon> even_light(std::size_t count, float edge = 1.0f)
    {
        std::vector<Photon> photons;
        for (std::size_t i = 0; i < count; i++) photons.push_back(make_test_photon({uniform(-1, edge), uniform(-1, 1), 0}, {1, 1, 1}));
        return photons;
    }

    std::mt19937 random_{7};
};

// Counts of photons within r of points at least `margin` from the square's sides.
struct Counts {
    double mean = 0.0, variance = 0.0;
};

Counts counts_of(const std::vector<Photon>& photons, double r, double margin, std::mt19937& random)
{
    std::uniform_real_distribution<double> place(-1.0 + margin, 1.0 - margin);
    constexpr int points = 2000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < points; i++) {
        const double x = place(random), y = place(random);
        int count = 0;
        for (const Photon& photon : photons) count += std::hypot(double(photon.position.x) - x, double(photon.position.y) - y) < r;
        sum += count;
        squares += double(count) * count;
    }
    return {sum / points, squares / points - sum / points * sum / points};
}

// One sweep of one photon, as the kernel's comment says; nothing where a decision is within rounding.
std::optional<Vec3d> plain_sweep(const std::vector<Photon>& photons, std::size_t self, double largest)
{
    struct Neighbour {
        double distance;
        Vec3d offset;
    };
    std::vector<Neighbour> near;
    for (std::size_t i = 0; i < photons.size(); i++) {
        const Vec3d offset = Vec3d(photons[i].position) - Vec3d(photons[self].position);
        if (i != self && length(offset) < largest) near.push_back({length(offset), offset});
    }
    std::sort(near.begin(), near.end(), [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
    if (near.size() > neighbours) {
        if (near[neighbours].distance - near[neighbours - 1].distance < 1e-5) return {};
        near.resize(neighbours);
    }
    const double one_sided = 1.2 / std::sqrt(double(neighbours));
    const double r = near.back().distance, n = static_cast<double>(near.size());
    Vec3d away(0, 0, 0), centroid(0, 0, 0);
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Neighbour& neighbour : near) {
        away = away - neighbour.offset * ((r / neighbour.distance - 1.0) / n);
        centroid = centroid + neighbour.offset * (1.0 / n);
        xx += neighbour.offset.x * neighbour.offset.x;
        xy += neighbour.offset.x * neighbour.offset.y;
        yy += neighbour.offset.y * neighbour.offset.y;
    }
    away = away + centroid * (1.0 / 3.0);
    const double root = std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy), ratio = (xx + yy - root) / (xx + yy + root);
    if (std::abs(ratio - 0.2) < 1e-3 || std::abs(length(centroid) / r - one_sided) < 1e-3) return {};
    if (ratio < 0.2) {
        const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
        const Vec3d line(std::cos(angle), std::sin(angle), 0);
        away = line * dot(away, line);
    }
    const double outwards = -dot(away, centroid);
    if (length(centroid) > one_sided * r && outwards > 0.0) away = away + centroid * (outwards / dot(centroid, centroid));
    return Vec3d(photons[self].position) + away;
}

TEST_F(RelaxPhotons, SweepDoesAsPlainCode)
{
    std::vector<Photon> photons = even_light(600, 0.3f);
    for (int i = 0; i < 100; i++)
        photons.push_back(make_test_photon({0.7f + uniform(-0.01f, 0.01f), uniform(-1, 1), 0}, {1, 1, 1})); // along a line
    const std::vector<Photon> moved = relaxed(photons, 1);
    int compared = 0;
    for (std::size_t i = 0; i < photons.size(); i++) {
        const auto expected = plain_sweep(photons, i, 1.0);
        if (!expected) continue;
        ++compared;
        EXPECT_NEAR(moved[i].position.x, expected->x, 1e-3 * length(*expected - Vec3d(photons[i].position)) + 1e-5)
            << i; // of the packed normal
        EXPECT_NEAR(moved[i].position.y, expected->y, 1e-3 * length(*expected - Vec3d(photons[i].position)) + 1e-5) << i;
        EXPECT_NEAR(moved[i].position.z, 0.0f, 2e-4f) << i;
    }
    EXPECT_GT(compared, 600);
}

// Poisson's counts have a variance equal to their mean; a relaxed one is much less, and the mean is the same.
TEST_F(RelaxPhotons, EvenLightLosesMostOfItsNoise)
{
    const std::vector<Photon> photons = even_light(8000), evened = relaxed(photons, 10);
    const double r = std::sqrt(10.0 * 4.0 / (8000.0 * pi)); // ten photons in the mean
    const Counts before = counts_of(photons, r, 0.2, random_), after = counts_of(evened, r, 0.2, random_);
    EXPECT_NEAR(before.variance, before.mean, 0.2 * before.mean);
    EXPECT_LT(after.variance, 0.5 * before.variance);
    // What lies within the margin is a count of 5120 photons with an error of 36: before by chance, after by what crossed its border.
    EXPECT_NEAR(after.mean, before.mean, 0.02 * before.mean);
    const auto flux = [](const std::vector<Photon>& some) {
        std::vector<float> sum;
        for (const Photon& photon : some) sum.push_back(photon.flux.x);
        return sum;
    };
    EXPECT_EQ(flux(evened), flux(photons));
}

// Blue noise: little power at frequencies below that of the photons' distance, where chance has as much as anywhere.
TEST_F(RelaxPhotons, EvenLightBecomesBlueNoise)
{
    const std::vector<Photon> photons = even_light(8000), evened = relaxed(photons, 10);
    const auto power = [&](const std::vector<Photon>& some, double low, double high) {
        return mean_power(some, 0.8, low, high, 400, random_);
    };
    // A standard error by chance is 0.05, or 0.07 where many of the few frequencies are drawn twice.
    for (const double f : {0.2, 0.5, 1.0, 2.0}) EXPECT_NEAR(power(photons, f, f + 0.15), 1.0, 0.3) << f;
    EXPECT_LT(power(evened, 0.2, 0.35), 0.1);
    EXPECT_LT(power(evened, 0.35, 0.65), 0.6);
    EXPECT_NEAR(power(evened, 2.0, 2.5), 1.0, 0.2) << "at short distances it stays chance";
}

// Light that grows from left to right as 1 + x keeps its gradient. Like heat it would flow by r^2 / 12 g = 4e-4 / (1 + x)^2 a sweep,
// 0.016 in forty where 1 + x is 1; a quarter of that would show.
TEST_F(RelaxPhotons, GradientsStay)
{
    std::vector<Photon> photons;
    while (photons.size() < 8000) {
        const Photon photon = make_test_photon({uniform(-1, 1), uniform(-1, 1), 0}, {1, 1, 1});
        if (uniform(-1, 1) < photon.position.x) photons.push_back(photon);
    }
    const auto mean_place = [](const std::vector<Photon>& some) {
        double sum = 0.0;
        for (const Photon& photon : some) sum += double(photon.position.x) / double(some.size());
        return sum;
    };
    EXPECT_NEAR(mean_place(relaxed(photons, 40)), mean_place(photons), 4e-3);
}

// As many photons lie beyond the edge after relaxation as rounding and chance let through, not a rim as wide as a disk.
TEST_F(RelaxPhotons, EdgesStay)
{
    const std::vector<Photon> evened = relaxed(even_light(8000, 0.0f), 10);
    const double spacing = std::sqrt(2.0 / 8000.0);
    std::size_t beyond = 0;
    for (const Photon& photon : evened) beyond += photon.position.x > spacing;
    // Within one spacing of the edge lie 1 / 63 of the photons, 126: less than a tenth of those went further out than it.
    EXPECT_LT(beyond, 13u);
}

// Two wavefronts through each other: a photon of one does not see the other's.
TEST_F(RelaxPhotons, WavefrontsThatCrossAreApart)
{
    std::vector<Photon> one = even_light(1000), both = one;
    for (Photon& photon : one) photon.direction = 0x80008000u;
    for (Photon& photon : both) photon.direction = 0x80008000u;
    for (Photon photon : even_light(1000)) {
        photon.direction = 0xc0008000u;
        both.push_back(photon);
    }
    const auto alone = relaxed(one, 3, 0.95f), together = relaxed(both, 3, 0.95f);
    for (std::size_t i = 0; i < alone.size(); i++) EXPECT_EQ(alone[i].position, together[i].position) << i;
    EXPECT_NE(relaxed(both, 3)[0].position, alone[0].position);
}

// Of other surfaces, above and facing down, nothing counts.
TEST_F(RelaxPhotons, SurfacesAreApart)
{
    std::vector<Photon> floor = even_light(500), both = floor;
    for (Photon photon : even_light(500)) {
        photon.normal_depth = packed_normal({0, 0, -1}) | (2u << PHOTON_DEPTH_SHIFT);
        both.push_back(photon);
    }
    const auto alone = relaxed(floor, 3), together = relaxed(both, 3);
    for (std::size_t i = 0; i < alone.size(); i++) EXPECT_EQ(alone[i].position, together[i].position) << i;
}

TEST_F(RelaxPhotons, FewPhotonsStayWhereTheyAre)
{
    EXPECT_TRUE(relaxed({}, 3).empty());
    EXPECT_EQ(relaxed({make_test_photon({0.5f, 0.5f, 0}, {1, 1, 1})}, 3)[0].position, (Vec3{0.5f, 0.5f, 0}));
    const std::vector<Photon> few = even_light(3);
    const auto moved = relaxed(few, 3);
    for (std::size_t i = 0; i < few.size(); i++) EXPECT_EQ(moved[i].position, few[i].position);
}

} // namespace
} // namespace sundog
