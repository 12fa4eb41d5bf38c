// Scattering: what bsdf_sample draws against bsdf_pdf_w and bsdf_evaluate, and specular models against Fresnel's
// equations, Snell's law and the scaling of radiance, all computed here in double precision.
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"

#include <complex>

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 151;
Bsdf diffuse(Vec3 reflectance)
{
    return flat_bsdf(DiffuseBsdf{reflectance});
}

Bsdf dielectric(uint type, double eta)
{
    return flat_bsdf(DielectricBsdf{static_cast<float>(eta), 1.0f, type == BSDF_THIN_DIELECTRIC, {}, {}});
}

using BsdfSampling = BsdfProbe;
using Sample = BsdfDraw;
using View = SurfaceSide;

// Unpolarised reflectance from Fresnel's amplitudes for a relative index that may be complex.
double fresnel(double cos_i, std::complex<double> index)
{
    const std::complex<double> cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (index * index));
    const std::complex<double> s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
    const std::complex<double> p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
    return 0.5 * (std::norm(s) + std::norm(p));
}

TEST_F(BsdfSampling, DiffuseFollowsItsDensity)
{
    constexpr uint count = 200'000;
    const Vec3d normal = normalized({0.3, -0.5, 0.8});
    const View view{normalized({0.9, 0.4, 0.3}), normal, normal};
    const std::vector<Bsdf> bsdfs = {diffuse({0.25f, 0.5f, 0.75f})};
    const DirectionGrid grid{.rows = 20, .columns = 24, .cap = 2.0, .frame = Frame3d(normal)};
    std::vector<float> densities;
    for (const Sample& s : evaluate(bsdfs, view, grid.midpoints(4))) densities.push_back(static_cast<float>(s.evaluated_pdf));

    std::vector<Vec3d> directions;
    for (const Sample& s : draw(bsdfs, view, carries_radiance, count)) {
        ASSERT_FALSE(s.absorbed());
        ASSERT_NEAR(length(s.direction), 1.0, 1e-5);
        ASSERT_NEAR(s.pdf, s.evaluated_pdf, 1e-4 * s.pdf + 1e-6);
        const double f_cos_over_pdf = s.evaluated * dot(s.direction, normal) / s.pdf;
        if (s.pdf > 1e-3) {
            ASSERT_NEAR(s.weight.x, f_cos_over_pdf, 1e-3);
        }
        ASSERT_EQ(s.weight.y, 0.5);
        ASSERT_EQ(s.eta_scale, 1.0);
        directions.push_back(s.direction);
    }
    EXPECT_TRUE(follows(grid.count(directions), grid.expected(densities, 4, count), tests_in_file));
}

// f(a, b) = f(b, a); the whole hemisphere reflects `reflectance`, and nothing passes to the other side.
TEST_F(BsdfSampling, DiffuseIsReciprocalAndConservesEnergy)
{
    const std::vector<Bsdf> bsdfs = {diffuse({0.8f, 0.8f, 0.8f})};
    const DirectionGrid grid{.rows = 10, .columns = 10};
    const Vec3d a = direction_at(0.4), b = direction_at(1.3);
    EXPECT_EQ(evaluate(bsdfs, {a}, {b})[0].evaluated, evaluate(bsdfs, {b}, {a})[0].evaluated);
    double reflected = 0.0, pdf = 0.0;
    const std::vector<Vec3d> directions = grid.midpoints(16);
    const auto samples = evaluate(bsdfs, {a}, directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double part = grid.solid_angle() / (16 * 16);
        reflected += samples[i].evaluated * std::abs(directions[i].z) * part;
        pdf += samples[i].evaluated_pdf * part;
    }
    EXPECT_NEAR(reflected, 0.8, 1e-4);
    EXPECT_NEAR(pdf, 1.0, 1e-4);
}

TEST_F(BsdfSampling, BacksAreBlackOrTheBackBsdf)
{
    const View behind{direction_at(2.5)};
    for (const Sample& s : draw({diffuse({0.5f, 0.5f, 0.5f})}, behind, carries_flux, 100)) ASSERT_TRUE(s.absorbed());
    EXPECT_EQ(evaluate({diffuse({0.5f, 0.5f, 0.5f})}, behind, {direction_at(2.0)})[0].evaluated, 0.0);

    Bsdf front = diffuse({0.25f, 0.25f, 0.25f});
    front.flags |= BSDF_TWO_SIDED;
    front.back = 1;
    const std::vector<Bsdf> sides = {front, diffuse({0.75f, 0.75f, 0.75f})};
    for (const Sample& s : draw(sides, behind, carries_flux, 1000)) {
        ASSERT_FALSE(s.absorbed());
        ASSERT_LT(s.direction.z, 0.0);
        ASSERT_EQ(s.weight.x, 0.75);
    }
    EXPECT_NEAR(evaluate(sides, behind, {direction_at(2.0)})[0].evaluated, 0.75 / pi, 1e-6);
    EXPECT_EQ(evaluate(sides, behind, {direction_at(1.0)})[0].evaluated, 0.0);
    for (const Sample& s : draw(sides, {direction_at(0.5)}, carries_flux, 1000)) ASSERT_EQ(s.weight.x, 0.25);
}

// Compares how often each of two things happened with their probabilities.
testing::AssertionResult frequency_is(double happened, double probability, double count)
{
    const std::vector<double> observed = {happened, count - happened}, expected = {probability * count, (1.0 - probability) * count};
    if (std::min(expected[0], expected[1]) < 5.0) { // too rare to test but for its absence
        return std::abs(happened - expected[0]) < 20.0 ? testing::AssertionSuccess()
                                                       : testing::AssertionFailure() << happened << " instead of " << expected[0];
    }
    return follows(observed, expected, tests_in_file);
}

class DielectricSampling : public BsdfSampling, public testing::WithParamInterface<double>
{
protected:
    // Angles to the normal, on both sides.
    const std::vector<double> angles_ = {0.01, 0.5, 0.9, 1.3, 1.55, pi - 0.01, pi - 0.4, pi - 0.72, pi - 0.9, pi - 1.4};
    static constexpr uint count_ = 50'000;
};

TEST_P(DielectricSampling, ReflectsAndRefractsByFresnelAndSnell)
{
    const double index = GetParam();
    for (const double angle : angles_) {
        const Vec3d o = direction_at(angle);
        const bool outside = o.z > 0.0;
        const double eta = outside ? static_cast<float>(index) : 1.0 / static_cast<float>(index); // far over near
        const double reflectance = fresnel(std::abs(o.z), eta);
        for (const uint carries : {carries_radiance, carries_flux}) {
            double reflections = 0.0;
            for (const Sample& s : draw({dielectric(BSDF_DIELECTRIC, index)}, {o}, carries, count_)) {
                ASSERT_FALSE(s.absorbed());
                ASSERT_EQ(s.pdf, 0.0);
                ASSERT_NEAR(length(s.direction), 1.0, 1e-5);
                if (s.direction.z * o.z > 0.0) {
                    ++reflections;
                    ASSERT_NEAR(length(s.direction - Vec3d(-o.x, -o.y, o.z)), 0.0, 1e-5);
                    ASSERT_EQ(s.weight.x, 1.0);
                    ASSERT_EQ(s.eta_scale, 1.0);
                    continue;
                }
                // Snell: tangential components shrink by eta and turn round. Near grazing the float cosine limits z.
                ASSERT_NEAR(s.direction.x, -o.x / eta, 3e-5) << angle;
                ASSERT_NEAR(s.direction.y, -o.y / eta, 3e-5) << angle;
                ASSERT_NEAR(s.weight.x, carries == carries_radiance ? 1.0 / (eta * eta) : 1.0, 1e-5);
                ASSERT_NEAR(s.eta_scale, eta * eta, 1e-5 * eta * eta);
            }
            EXPECT_TRUE(frequency_is(reflections, reflectance, count_)) << "at " << angle << " rad, index " << index;
        }
    }
}

TEST_P(DielectricSampling, ThinPanesPassLightUnbent)
{
    const double index = GetParam();
    for (const double angle : angles_) {
        const Vec3d o = direction_at(angle);
        const double face = fresnel(std::abs(o.z), static_cast<float>(index)); // the same on both sides
        // R + T^2 R + T^2 R^3 + ... = 2 R / (1 + R): reflections between the two faces.
        double reflectance = face, inside = (1.0 - face) * (1.0 - face) * face;
        for (int bounce = 0; bounce < 10'000 && face < 1.0; ++bounce, inside *= face * face) reflectance += inside;
        double reflections = 0.0;
        for (const Sample& s : draw({dielectric(BSDF_THIN_DIELECTRIC, index)}, {o}, carries_radiance, count_)) {
            ASSERT_FALSE(s.absorbed());
            const bool reflected = s.direction.z * o.z > 0.0;
            reflections += reflected ? 1.0 : 0.0;
            ASSERT_NEAR(length(s.direction - (reflected ? Vec3d(-o.x, -o.y, o.z) : -o)), 0.0, 1e-5);
            ASSERT_EQ(s.weight.x, 1.0);
            ASSERT_EQ(s.eta_scale, 1.0);
        }
        EXPECT_TRUE(frequency_is(reflections, reflectance, count_)) << "at " << angle << " rad, index " << index;
    }
}

INSTANTIATE_TEST_SUITE_P(Indices, DielectricSampling, testing::Values(1.0, 1.33, 1.5046, 2.4, 0.75),
                         [](const auto& index) { return "Index" + std::to_string(static_cast<int>(index.param * 100)); });

// Copper, gold-like and a perfect mirror, channel by channel.
TEST_F(BsdfSampling, ConductorsReflectByFresnel)
{
    const Bsdf metal = flat_bsdf(ConductorBsdf{{0.2f, 1.5f, 0.0f}, {3.9f, 1.9f, 1.0f}, {1.0f, 1.0f, 0.5f}});
    for (const double angle : {0.0, 0.3, 0.8, 1.2, 1.5, 1.568}) {
        const Vec3d o = direction_at(angle);
        const Sample s = draw({metal}, {o}, carries_radiance, 1)[0];
        ASSERT_NEAR(length(s.direction - Vec3d(-o.x, -o.y, o.z)), 0.0, 1e-5);
        EXPECT_NEAR(s.weight.x, fresnel(o.z, {static_cast<double>(0.2f), static_cast<double>(3.9f)}), 2e-5) << angle;
        EXPECT_NEAR(s.weight.y, fresnel(o.z, {static_cast<double>(1.5f), static_cast<double>(1.9f)}), 2e-5) << angle;
        EXPECT_NEAR(s.weight.z, 0.5, 2e-5) << "a perfect mirror at " << angle;
        EXPECT_EQ(s.pdf, 0.0);
    }
    EXPECT_TRUE(draw({metal}, {direction_at(2.0)}, carries_radiance, 1)[0].absorbed());
}

TEST_F(BsdfSampling, NullPassesEverything)
{
    const Bsdf none = flat_bsdf(NullBsdf{});
    for (const double angle : {0.3, 1.5, 2.2}) {
        const Sample s = draw({none}, {direction_at(angle)}, carries_flux, 1)[0];
        EXPECT_NEAR(length(s.direction + direction_at(angle)), 0.0, 1e-6);
        EXPECT_EQ(s.weight.x, 1.0);
    }
}

// With interpolated normals no path crosses the face by a reflection, nor stays by a refraction.
TEST_F(BsdfSampling, InterpolatedNormalsDoNotLeak)
{
    const Vec3d shading = normalized({0.6, 0.0, 0.8});
    const View view{normalized({0.9, 0.1, 0.35}), {0, 0, 1}, shading};
    int absorbed = 0;
    for (const Bsdf& bsdf : {diffuse({0.5f, 0.5f, 0.5f}), dielectric(BSDF_DIELECTRIC, 1.5)}) {
        for (const Sample& s : draw({bsdf}, view, carries_flux, 10'000)) {
            if (s.absorbed()) {
                ++absorbed;
                continue;
            }
            ASSERT_EQ(s.direction.z > 0.0, dot(s.direction, shading) > 0.0);
            if (bsdf.type == BSDF_DIFFUSE) {
                ASSERT_GT(s.evaluated, 0.0);
            }
        }
    }
    EXPECT_GT(absorbed, 100) << "the case did not arise";
    EXPECT_EQ(evaluate({diffuse({0.5f, 0.5f, 0.5f})}, view, {normalized({0.8, 0.0, -0.1})})[0].evaluated, 0.0)
        << "light from below the face";
}

} // namespace
} // namespace sundog
