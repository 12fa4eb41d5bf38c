// Scattering: what bsdf_sample draws against bsdf_pdf_w and bsdf_evaluate, and specular models against Fresnel's
// equations, Snell's law and the scaling of radiance, all computed here in double precision.
#include "shared/bsdf.h"
#include "shared/geometry.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/direction_grid.h"

#include <complex>

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 151;
constexpr uint carries_radiance = 0, carries_flux = 1;

struct Sample {
    Vec3d direction; // zero where the path was absorbed
    Vec3d weight;
    double pdf, eta_scale;
    double evaluated_pdf, evaluated; // bsdf_pdf_w and the red of bsdf_evaluate for the direction
    bool absorbed() const { return length(direction) == 0.0; }
};

// A surface point and the side it is seen from.
struct View {
    Vec3d outgoing;
    Vec3d geometric_normal{0, 0, 1};
    Vec3d shading_normal{0, 0, 1};
};

class BsdfSampling : public DeviceFixture
{
protected:
    // Directions are drawn, or, where `given` is not empty, taken from there.
    std::vector<Sample> run(const std::vector<Bsdf>& bsdfs, const View& view, uint carries, uint count, const std::vector<Vec3>& given = {})
    {
        const auto shapes = upload(std::vector<Shape>{{0, NO_LIGHT, 0, 0}});
        const auto output = allocate<float>(std::size_t(10) * count);
        const auto directions = upload(given.empty() ? std::vector<Vec3>(1) : given);
        kernel_(count, upload(bsdfs), shapes, to_float(view.outgoing), to_float(view.geometric_normal), to_float(view.shading_normal),
                carries, count, uint(given.empty() ? 0 : 1), directions, output);
        const auto values = output.download();
        std::vector<Sample> samples(count);
        for (std::size_t i = 0; i < count; ++i) {
            const float* v = &values[10 * i];
            samples[i] = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7], v[8], v[9]};
        }
        return samples;
    }

    std::vector<Sample> evaluate(const std::vector<Bsdf>& bsdfs, const View& view, const std::vector<Vec3d>& directions)
    {
        std::vector<Vec3> given;
        for (Vec3d d : directions) given.push_back(to_float(d));
        return run(bsdfs, view, carries_radiance, static_cast<uint>(given.size()), given);
    }

private:
    Kernel kernel_ = test_kernel(R"(
        #include "scene/bsdf.h"
        __kernel void test(__global const Bsdf* bsdfs, __global const Shape* shapes, Vec3 outgoing, Vec3 geometric_normal, Vec3 shading_normal, uint carries,
                           uint count, uint given, __global const Vec3* directions, __global float* output)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            SurfaceView scene;
            scene.bsdfs = bsdfs;
            scene.shapes = shapes;
            Surface surface;
            surface.position = (float3)(0.0f);
            surface.outgoing = unpack(outgoing);
            surface.geometric_normal = unpack(geometric_normal);
            surface.shading_normal = unpack(shading_normal);
            surface.offset = 0.0f;
            surface.shape = 0u;
            surface.primitive = 0u;
            const Scattering scattering = scattering_at(&scene, &surface);
            BsdfSample sample = {(float3)(0.0f), (float3)(0.0f), 0.0f, 1.0f};
            if (given) sample.direction = unpack(directions[i]);
            else if (!bsdf_sample(&scattering, &surface, random4(i, 3u + carries), (int)carries, &sample)) sample.direction = (float3)(0.0f);
            vstore3(sample.direction, 0, output + 10u * i);
            vstore3(sample.weight, 0, output + 10u * i + 3u);
            output[10u * i + 6u] = sample.pdf_w;
            output[10u * i + 7u] = sample.eta_scale;
            output[10u * i + 8u] = bsdf_pdf_w(&scattering, sample.direction);
            output[10u * i + 9u] = bsdf_evaluate(&scattering, &surface, sample.direction).x;
        })");
};

Bsdf diffuse(Vec3 reflectance)
{
    Bsdf bsdf{};
    bsdf.type = BSDF_DIFFUSE;
    bsdf.reflectance = reflectance;
    return bsdf;
}

Bsdf dielectric(uint type, double eta)
{
    Bsdf bsdf{};
    bsdf.type = type;
    bsdf.eta = static_cast<float>(eta);
    bsdf.reflectance = {1, 1, 1};
    bsdf.transmittance = {1, 1, 1};
    return bsdf;
}

// Direction at an angle (rad) to +z, at some azimuth.
Vec3d at_angle(double angle)
{
    return {std::sin(angle) * std::cos(0.7), std::sin(angle) * std::sin(0.7), std::cos(angle)};
}

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
    for (const Sample& s : run(bsdfs, view, carries_radiance, count)) {
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
    const Vec3d a = at_angle(0.4), b = at_angle(1.3);
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
    const View behind{at_angle(2.5)};
    for (const Sample& s : run({diffuse({0.5f, 0.5f, 0.5f})}, behind, carries_flux, 100)) ASSERT_TRUE(s.absorbed());
    EXPECT_EQ(evaluate({diffuse({0.5f, 0.5f, 0.5f})}, behind, {at_angle(2.0)})[0].evaluated, 0.0);

    Bsdf front = diffuse({0.25f, 0.25f, 0.25f});
    front.flags = BSDF_TWO_SIDED;
    front.back = 1;
    const std::vector<Bsdf> sides = {front, diffuse({0.75f, 0.75f, 0.75f})};
    for (const Sample& s : run(sides, behind, carries_flux, 1000)) {
        ASSERT_FALSE(s.absorbed());
        ASSERT_LT(s.direction.z, 0.0);
        ASSERT_EQ(s.weight.x, 0.75);
    }
    EXPECT_NEAR(evaluate(sides, behind, {at_angle(2.0)})[0].evaluated, 0.75 / pi, 1e-6);
    EXPECT_EQ(evaluate(sides, behind, {at_angle(1.0)})[0].evaluated, 0.0);
    for (const Sample& s : run(sides, {at_angle(0.5)}, carries_flux, 1000)) ASSERT_EQ(s.weight.x, 0.25);
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
        const Vec3d o = at_angle(angle);
        const bool outside = o.z > 0.0;
        const double eta = outside ? static_cast<float>(index) : 1.0 / static_cast<float>(index); // far over near
        const double reflectance = fresnel(std::abs(o.z), eta);
        for (const uint carries : {carries_radiance, carries_flux}) {
            double reflections = 0.0;
            for (const Sample& s : run({dielectric(BSDF_DIELECTRIC, index)}, {o}, carries, count_)) {
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
        const Vec3d o = at_angle(angle);
        const double face = fresnel(std::abs(o.z), static_cast<float>(index)); // the same on both sides
        // R + T^2 R + T^2 R^3 + ... = 2 R / (1 + R): reflections between the two faces.
        double reflectance = face, inside = (1.0 - face) * (1.0 - face) * face;
        for (int bounce = 0; bounce < 10'000 && face < 1.0; ++bounce, inside *= face * face) reflectance += inside;
        double reflections = 0.0;
        for (const Sample& s : run({dielectric(BSDF_THIN_DIELECTRIC, index)}, {o}, carries_radiance, count_)) {
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
    Bsdf metal{};
    metal.type = BSDF_CONDUCTOR;
    metal.reflectance = {1.0f, 1.0f, 0.5f};
    metal.eta_rgb = {0.2f, 1.5f, 0.0f};
    metal.k_rgb = {3.9f, 1.9f, 1.0f};
    for (const double angle : {0.0, 0.3, 0.8, 1.2, 1.5, 1.568}) {
        const Vec3d o = at_angle(angle);
        const Sample s = run({metal}, {o}, carries_radiance, 1)[0];
        ASSERT_NEAR(length(s.direction - Vec3d(-o.x, -o.y, o.z)), 0.0, 1e-5);
        EXPECT_NEAR(s.weight.x, fresnel(o.z, {static_cast<double>(0.2f), static_cast<double>(3.9f)}), 2e-5) << angle;
        EXPECT_NEAR(s.weight.y, fresnel(o.z, {static_cast<double>(1.5f), static_cast<double>(1.9f)}), 2e-5) << angle;
        EXPECT_NEAR(s.weight.z, 0.5, 2e-5) << "a perfect mirror at " << angle;
        EXPECT_EQ(s.pdf, 0.0);
    }
    EXPECT_TRUE(run({metal}, {at_angle(2.0)}, carries_radiance, 1)[0].absorbed());
}

TEST_F(BsdfSampling, NullPassesEverything)
{
    Bsdf none{};
    none.type = BSDF_NULL;
    for (const double angle : {0.3, 1.5, 2.2}) {
        const Sample s = run({none}, {at_angle(angle)}, carries_flux, 1)[0];
        EXPECT_NEAR(length(s.direction + at_angle(angle)), 0.0, 1e-6);
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
        for (const Sample& s : run({bsdf}, view, carries_flux, 10'000)) {
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
