// Microfacet lobes: samples follow their densities, weights are f cos / pdf, reciprocity (with the squared index for
// refraction), energy, and the adjoint of refraction; for both distributions, isotropic and anisotropic.
#include "scene/flatten_bsdfs.h"
#include "shared/geometry.h"
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"

namespace sundog
{
namespace
{

using std::numbers::pi;

struct Case {
    const char* name;
    bool beckmann;
    float alpha_u, alpha_v;
    bool dielectric;
};

// Printed by name.
void PrintTo(const Case& test, std::ostream* out)
{
    *out << test.name;
}

const std::vector<double> angles = {0.0, 0.4, 1.1, 1.35};
constexpr int cases = 8, tests_in_file = cases * 2 * 2 * 4;

class RoughLobes : public BsdfProbe, public testing::WithParamInterface<Case>
{
protected:
    std::vector<Bsdf> bsdfs(bool white = true) const
    {
        const Case& test = GetParam();
        const Roughness roughness{test.beckmann, test.alpha_u, test.alpha_v};
        if (test.dielectric) return {flat_bsdf(DielectricBsdf{1.5f, 1.0f, false, {}, {}, roughness})};
        const ConductorBsdf mirror{{0, 0, 0}, {1, 1, 1}, {}, roughness}, metal{{0.2f, 1.5f, 1.1f}, {3.9f, 1.9f, 2.5f}, {}, roughness};
        return {flat_bsdf(white ? mirror : metal)};
    }
    // Both sides for a dielectric, else the front.
    std::vector<Vec3d> views() const
    {
        std::vector<Vec3d> list;
        for (const double angle : angles) {
            list.push_back(direction_at(angle));
            if (GetParam().dielectric) list.push_back(direction_at(pi - angle));
        }
        return list;
    }
};

// The lobes are wide enough for 20 x 20 midpoints in each of 24 x 48 bins to integrate them (the totals are checked):
// roughness at least 0.3, and for glass, whose refracted lobes are a third as wide, 0.7.
TEST_P(RoughLobes, SamplesFollowTheirDensity)
{
    if (GetParam().name == std::string("GgxFineMetal")) return; // too peaked; its energy is tested below
    constexpr uint count = 100'000;
    const DirectionGrid grid{.rows = 48, .columns = 24};
    const std::vector<Vec3d> midpoints = grid.midpoints(20);
    for (const Vec3d o : views()) {
        std::vector<float> densities;
        for (const BsdfDraw& s : evaluate(bsdfs(), {o}, midpoints)) densities.push_back(static_cast<float>(s.evaluated_pdf));
        std::vector<Vec3d> directions;
        for (const BsdfDraw& s : draw(bsdfs(), {o}, carries_radiance, count)) {
            if (s.absorbed()) continue;
            // The grid measures height by the sine, which has no digits left for it within 1e-3 of the horizon: such a
            // direction counts on the side that it was drawn for.
            Vec3d direction = s.direction;
            const double side = (s.eta_scale == 1.0) == (o.z > 0.0) ? 1.0 : -1.0;
            if (std::abs(direction.z) < 1e-3) direction = normalized({direction.x, direction.y, side * 2e-3});
            directions.push_back(direction);
        }
        // What is absorbed went below the surface: its density is not asked for. The rest must be as dense as stated.
        std::vector<double> observed = grid.count(directions), expected = grid.expected(densities, 20, count);
        const double missing = count - static_cast<double>(directions.size());
        double total = 0.0;
        for (double e : expected) total += e;
        EXPECT_NEAR(missing, count - total, 4.0 * std::sqrt(missing) + 2e-3 * count) << "absorbed, from z = " << o.z;
        EXPECT_TRUE(follows(observed, expected, tests_in_file, 1e-2)) << "from z = " << o.z;
    }
}

TEST_P(RoughLobes, WeightsAreValueTimesCosineOverDensity)
{
    for (const uint carries : {carries_radiance, carries_flux}) {
        for (const Vec3d o : views()) {
            for (const BsdfDraw& s : draw(bsdfs(false), {o}, carries, 5'000)) {
                if (s.absorbed() || s.pdf < 1e-3) continue;
                ASSERT_NEAR(length(s.direction), 1.0, 1e-5);
                // Both are computed from the half vector, once sampled and once from the directions, whose rounding (1e-7)
                // the peak of the lobe magnifies, and the more so the more grazing they are.
                const double tolerance = 2e-3 + 2e-6 / (std::abs(s.direction.z) * std::max(std::abs(o.z), 0.01));
                ASSERT_NEAR(s.evaluated_pdf / s.pdf, 1.0, 5.0 * tolerance) << o.z << " to " << s.direction.z;
                const double expected = s.evaluated * std::abs(s.direction.z) / s.evaluated_pdf;
                ASSERT_NEAR(s.weight.x, expected, tolerance * (1.0 + expected)) << o.z << " to " << s.direction.z;
            }
        }
    }
}

// f(i, o) = f(o, i) for reflection; for refraction of radiance eta_o^2 f(i, o) = eta_i^2 f(o, i) [Veach 1997, eq. 5.14]:
// light that goes i -> o as radiance is the flux that goes the other way round.
TEST_P(RoughLobes, AreReciprocal)
{
    const std::vector<Vec3d> directions = {direction_at(0.3), normalized({-0.5, 0.2, 0.4}), normalized({0.1, -0.8, 0.3}), normalized({0.2, 0.1, -0.9}),
                                           normalized({-0.4, 0.1, -0.7})};
    for (const Vec3d a : directions) {
        for (const Vec3d b : directions) {
            const double forth = evaluate(bsdfs(), {a}, {b}, carries_radiance)[0].evaluated;
            const double back = evaluate(bsdfs(), {b}, {a}, carries_flux)[0].evaluated;
            EXPECT_NEAR(forth, back, 1e-3 * std::abs(forth) + 1e-7) << "adjoint";
            if (a.z * b.z < 0.0) {
                const double eta = a.z > 0.0 ? 1.5 : 1.0 / 1.5; // of b's side over a's
                EXPECT_NEAR(forth * eta * eta, evaluate(bsdfs(), {b}, {a}, carries_radiance)[0].evaluated, 1e-3 * std::abs(forth) * eta * eta + 1e-7);
            }
        }
    }
}

// A white microsurface never reflects more than arrives; single scattering loses some, the less the smoother it is.
TEST_P(RoughLobes, ConserveEnergy)
{
    for (const Vec3d o : views()) {
        const auto samples = draw(bsdfs(), {o}, carries_flux, 20'000);
        double mean = 0.0, squares = 0.0;
        for (const BsdfDraw& s : samples) {
            const double w = s.absorbed() ? 0.0 : s.weight.x;
            mean += w / static_cast<double>(samples.size());
            squares += w * w / static_cast<double>(samples.size());
        }
        const double error = std::sqrt(std::max(0.0, squares - mean * mean) / static_cast<double>(samples.size()));
        EXPECT_LT(mean, 1.0 + 4.0 * error) << o.z;
        EXPECT_GT(mean, 0.3) << o.z;
        // Seen from above, GGX facets steeper than 45 degrees, alpha^2 / (1 + alpha^2) of all, throw light below the
        // horizon; shadowing takes less than that again.
        if (GetParam().name == std::string("GgxFineMetal") && o.z == 1.0) {
            const double steep = 0.15 * 0.15 / (1.0 + 0.15 * 0.15);
            EXPECT_LT(mean, 1.0 - steep + 4.0 * error);
            EXPECT_GT(mean, 1.0 - 2.0 * steep);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Lobes, RoughLobes,
                         testing::Values(Case{"GgxMetal", false, 0.3f, 0.3f, false}, Case{"BeckmannMetal", true, 0.3f, 0.3f, false},
                                         Case{"GgxBrushed", false, 0.3f, 0.6f, false}, Case{"BeckmannBrushed", true, 0.6f, 0.3f, false},
                                         Case{"GgxFineMetal", false, 0.15f, 0.15f, false}, Case{"GgxGlass", false, 0.7f, 0.7f, true},
                                         Case{"BeckmannGlass", true, 0.7f, 0.7f, true}, Case{"GgxBrushedGlass", false, 1.0f, 0.7f, true}),
                         [](const auto& test) { return std::string(test.param.name); });

// Masks and blends choose their parts as often as their weights say.
TEST_F(BsdfProbe, MixturesChooseByWeight)
{
    const auto records = [](const MaskBsdf& mask, const BlendBsdf& blend) {
        return flatten_bsdfs({{"", {}, DiffuseBsdf{{0.25f, 0.25f, 0.25f}}}, {"", {}, DiffuseBsdf{{0.75f, 0.75f, 0.75f}}}, {"", {}, mask}, {"", {}, blend}});
    };
    constexpr uint count = 40'000;
    const double four_sigma = 4.0 * std::sqrt(0.3 * 0.7 / count);
    MaskBsdf mask;
    mask.opacity = 0.3f;
    mask.nested = 0;
    BlendBsdf blend;
    blend.weight = 0.3f;
    blend.nested[0] = 0;
    blend.nested[1] = 2;
    const auto bsdfs = records(mask, blend);

    double opaque = 0.0;
    for (const BsdfDraw& s : draw(bsdfs, {direction_at(0.5)}, carries_flux, count, 2)) opaque += s.pdf > 0.0 ? 1.0 / count : 0.0;
    EXPECT_NEAR(opaque, 0.3, four_sigma);

    // First 0.7; then of the mask's 0.3 again 0.3.
    double passed = 0.0;
    for (const BsdfDraw& s : draw(bsdfs, {direction_at(0.5)}, carries_flux, count, 3)) passed += s.pdf == 0.0 ? 1.0 / count : 0.0;
    EXPECT_NEAR(passed, 0.3 * 0.7, four_sigma);
}

} // namespace
} // namespace sundog
