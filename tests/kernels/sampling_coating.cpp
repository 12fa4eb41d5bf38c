// Coatings: the layer's surface and what is below add up to the model, samples follow their densities, light finds the same way
// back, and none is made.
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"
#include "support/plain_bsdf.h"

namespace sundog
{
namespace
{

using Model = decltype(BsdfDescription::model);

const std::vector<double> angles = {0.0, 0.5, 1.1, 1.45};
constexpr int tests_in_file = 3 * 4;
constexpr double eta = 1.5;

CoatingBsdf coating(Vec3 specular, Vec3 depth = {0, 0, 0}, std::optional<Roughness> roughness = std::nullopt)
{
    CoatingBsdf bsdf;
    bsdf.int_ior = 1.5f;
    bsdf.ext_ior = 1.0f;
    bsdf.thickness = 0.5f;
    bsdf.sigma_a = depth * 2.0f;
    bsdf.specular_reflectance = specular;
    bsdf.roughness = roughness;
    return bsdf;
}

ProbeScene over(const Model& base, const CoatingBsdf& coat)
{
    return ProbeScene({base, coat});
}

struct Mean {
    double value, error; // and its standard error
};
template <class Quantity> Mean mean_of(const std::vector<BsdfDraw>& draws, Quantity quantity)
{
    double sum = 0.0, squares = 0.0;
    for (const auto& v : draws) sum += quantity(v), squares += quantity(v) * quantity(v);
    const double n = static_cast<double>(draws.size()), mean = sum / n;
    return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
}

Mean albedo_of(const std::vector<BsdfDraw>& draws)
{
    return mean_of(draws, [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
}

// Cosine of the direction within the layer.
double below(double cosine)
{
    return std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
}

double passes(double cosine_o, double cosine_i, double depth)
{
    return (1.0 - fresnel_reflectance(cosine_o, eta)) * (1.0 - fresnel_reflectance(cosine_i, eta)) *
           std::exp(-depth * (1.0 / below(cosine_o) + 1.0 / below(cosine_i)));
}

using Coating = BsdfProbe;

// s F + (1 - F)^2 exp(-2 d / cos'): the layer's surface, and the mirror below it.
TEST_F(Coating, OverAMirror)
{
    ConductorBsdf mirror;
    for (const double depth : {0.0, 0.3}) {
        for (const double angle : angles) {
            const double cosine = std::cos(angle), reflected = fresnel_reflectance(cosine, eta);
            const auto coat = coating({0.5f, 0.5f, 0.5f}, Vec3{1, 1, 1} * static_cast<float>(depth));
            const auto draws = draw(over(mirror, coat), {direction_at(angle)}, carries_flux, 20'000);
            const Mean albedo = albedo_of(draws);
            EXPECT_NEAR(albedo.value, 0.5 * reflected + passes(cosine, cosine, depth), 4.5 * albedo.error + 1e-4) << angle;
            for (const BsdfDraw& s : draws) { // both are mirrors about the same normal
                ASSERT_EQ(s.pdf, 0.0);
                ASSERT_NEAR(length(s.direction - direction_at(-angle)), 0.0, 1e-5);
            }
        }
    }
}

// f = rho T(o) T(i) exp(-d (1 / cos o' + 1 / cos i')) / (pi eta^2), in the mean over the choices, beside the mirrored direction.
TEST_F(Coating, OverADiffuseBase)
{
    for (const double depth : {0.0, 0.4}) {
        const auto scene = over(DiffuseBsdf{{0.7f, 0.2f, 0.1f}}, coating({1, 1, 1}, Vec3{1, 0.5f, 2} * static_cast<float>(depth)));
        for (const double angle_o : angles) {
            for (const double angle_i : angles) {
                const Vec3d o = direction_at(angle_o), i = normalized(Vec3d(-0.3, 0.8, 0) * std::sin(angle_i) / std::hypot(0.3, 0.8) + Vec3d(0, 0, std::cos(angle_i)));
                const Mean f = mean_of(evaluate(scene, {o}, std::vector<Vec3d>(5'000, i)), [](const BsdfDraw& s) { return s.evaluated; });
                const double model = 0.7 * passes(o.z, i.z, depth) / (std::numbers::pi * eta * eta);
                EXPECT_NEAR(f.value, model, 4.5 * f.error + 1e-4 * model) << angle_o << " and " << angle_i;
            }
        }
    }
}

const std::vector<std::pair<const char*, Model>> bases = {
    {"diffuse", DiffuseBsdf{{1, 1, 1}}},
    {"rough metal", ConductorBsdf{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, Roughness{false, 0.4f, 0.4f}}},
    {"phong", PhongBsdf{{0, 0, 0}, {1, 1, 1}, 12.0f}}};

// What is below alone: the layer's surface is black. What is turned back within the layer has no direction outside.
TEST_F(Coating, SamplesFollowTheirDensity)
{
    constexpr uint count = 60'000;
    const DirectionGrid grid{.rows = 24, .columns = 20, .cap = 1.0};
    const std::vector<Vec3d> midpoints = grid.midpoints(12);
    for (const auto& [name, base] : bases) {
        const auto scene = over(base, coating({0, 0, 0}, {0.1f, 0.1f, 0.1f}));
        for (const double angle : angles) {
            std::vector<float> densities;
            for (const BsdfDraw& s : evaluate(scene, {direction_at(angle)}, midpoints)) densities.push_back(static_cast<float>(s.evaluated_pdf));
            std::vector<Vec3d> directions;
            for (const BsdfDraw& s : draw(scene, {direction_at(angle)}, carries_radiance, count)) {
                if (s.absorbed()) continue;
                directions.push_back(s.direction.z < 1e-3 ? normalized({s.direction.x, s.direction.y, 2e-3}) : s.direction);
                if (s.pdf < 1e-3 || s.direction.z < 0.02) continue;
                ASSERT_NEAR(s.evaluated_pdf / s.pdf, 1.0, 1e-2) << name << ", " << angle << " to " << s.direction.z;
                ASSERT_NEAR(s.weight.x, s.evaluated * s.direction.z / s.pdf, 1e-2 * (s.weight.x + 0.1)) << name << ", " << angle << " to " << s.direction.z;
            }
            const std::vector<double> observed = grid.count(directions), expected = grid.expected(densities, 12, count);
            EXPECT_TRUE(follows(observed, expected, tests_in_file, 2e-2)) << name << " from " << angle;
        }
    }
}

TEST_F(Coating, IsReciprocal)
{
    const std::vector<Vec3d> directions = {direction_at(0.3), normalized({-0.5, 0.2, 0.4}), normalized({0.1, -0.8, 0.3})};
    for (const auto& [name, base] : bases) {
        const auto scene = over(base, coating({0, 0, 0}, {0.2f, 0.2f, 0.2f}));
        for (const Vec3d a : directions)
            for (const Vec3d b : directions) {
                const double forth = evaluate(scene, {a}, {b}, carries_radiance)[0].evaluated;
                EXPECT_NEAR(forth, evaluate(scene, {b}, {a}, carries_flux)[0].evaluated, 1e-3 * forth + 1e-7) << name;
                EXPECT_NEAR(forth, evaluate(scene, {a}, {b}, carries_flux)[0].evaluated, 1e-6 * forth) << name;
            }
    }
}

TEST_F(Coating, MakesNoLight)
{
    std::vector<std::optional<Roughness>> surfaces{std::nullopt};
    for (const float alpha : {0.1f, 0.4f, 1.0f})
        for (const bool beckmann : {false, true}) surfaces.push_back(Roughness{beckmann, alpha, alpha});
    auto whites = bases;
    whites.push_back({"mirror", ConductorBsdf{}});
    for (const auto& [name, base] : whites)
        for (const auto& surface : surfaces)
            for (const double angle : angles) {
                const Mean albedo = albedo_of(draw(over(base, coating({1, 1, 1}, {0, 0, 0}, surface)), {direction_at(angle)}, carries_flux, 10'000));
                EXPECT_LT(albedo.value, 1.0 + 4.5 * albedo.error + 1e-4) << name << " at " << angle;
                EXPECT_GT(albedo.value, 0.15) << name << " at " << angle;
            }
}

TEST_F(Coating, IsBlackFromBehind)
{
    const auto scene = over(DiffuseBsdf{}, coating({1, 1, 1}));
    for (const BsdfDraw& s : draw(scene, {direction_at(2.5)}, carries_radiance, 1'000)) ASSERT_TRUE(s.absorbed());
}

} // namespace
} // namespace sundog
