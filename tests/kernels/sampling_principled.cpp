// The principled BSDF: in the mean over its choices it is the model, its lobes sample what their densities say, go both
// ways alike, and keep as much light as the model does.
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"
#include "support/plain_principled.h"

namespace sundog
{
namespace
{

const std::vector<double> angles = {0.1, 0.6, 1.2, 1.45};

struct Mean {
    double value, error; // and its standard error
};
template <class Values, class Quantity> Mean mean_of(const Values& values, Quantity quantity)
{
    double sum = 0.0, squares = 0.0;
    for (const auto& v : values) sum += quantity(v), squares += quantity(v) * quantity(v);
    const double n = static_cast<double>(values.size()), mean = sum / n;
    return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
}

// The probe's tangent: along (1, 0.5, 0).
Vec3d in_tangent_frame(Vec3d v)
{
    const double c = 1.0 / std::sqrt(1.25), s = 0.5 * c;
    return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

// All parameters that change a part, at odd values.
PrincipledBsdf mixed()
{
    PrincipledBsdf bsdf;
    bsdf.base_color = ColorSource(0.8f, 0.4f, 0.2f);
    bsdf.roughness = 0.6f;
    bsdf.anisotropic = 0.7f;
    bsdf.metallic = 0.3f;
    bsdf.spec_trans = 0.6f;
    bsdf.eta = 1.4f;
    bsdf.spec_tint = 0.4f;
    bsdf.sheen = 0.7f;
    bsdf.sheen_tint = 0.6f;
    bsdf.flatness = 0.4f;
    bsdf.clearcoat = 0.9f;
    bsdf.clearcoat_gloss = 0.2f;
    return bsdf;
}

PrincipledBsdf with(PrincipledBsdf bsdf, float eta, float spec_trans)
{
    bsdf.eta = eta;
    bsdf.spec_trans = spec_trans;
    return bsdf;
}

// Sheen on a base that is black.
PrincipledBsdf dark_cloth()
{
    PrincipledBsdf bsdf = mixed();
    bsdf.base_color = ColorSource(0.0f, 0.0f, 0.0f);
    bsdf.metallic = 0.0f;
    bsdf.spec_trans = 0.0f;
    return bsdf;
}

// One part alone, white: all others are black.
PrincipledBsdf diffuse_part(float flatness, float sheen)
{
    PrincipledBsdf bsdf;
    bsdf.base_color = ColorSource(1.0f, 1.0f, 1.0f);
    bsdf.roughness = 0.8f;
    bsdf.eta = 1.0f;
    bsdf.flatness = flatness;
    bsdf.sheen = sheen;
    return bsdf;
}
PrincipledBsdf metal_part(float roughness, float anisotropic)
{
    PrincipledBsdf bsdf;
    bsdf.base_color = ColorSource(1.0f, 1.0f, 1.0f);
    bsdf.roughness = roughness;
    bsdf.anisotropic = anisotropic;
    bsdf.metallic = 1.0f;
    return bsdf;
}
PrincipledBsdf coat_part(float gloss)
{
    PrincipledBsdf bsdf = diffuse_part(0.0f, 0.0f);
    bsdf.base_color = ColorSource(0.0f, 0.0f, 0.0f);
    bsdf.clearcoat = 1.0f;
    bsdf.clearcoat_gloss = gloss;
    return bsdf;
}
PrincipledBsdf glass_part(float roughness)
{
    PrincipledBsdf bsdf = metal_part(roughness, 0.5f);
    bsdf.metallic = 0.0f;
    bsdf.spec_trans = 1.0f;
    return bsdf;
}

class PrincipledLobes : public BsdfProbe
{
};

TEST_F(PrincipledLobes, AreTheModelInTheMean)
{
    for (const PrincipledBsdf& bsdf :
         {mixed(), with(mixed(), 1.4f, 0.0f), with(mixed(), 0.7f, 0.5f), with(mixed(), 1.0f, 0.0f), dark_cloth()}) {
        const PlainPrincipled model(bsdf);
        const ProbeScene scene({BsdfDescription{"", {}, bsdf}.model});
        for (const double angle_o : {0.3, 1.3, pi - 0.7}) {
            for (const Vec3d i : {normalized({-0.4, -0.3, 0.7}), normalized({-0.8, 0.1, 0.15}), normalized({0.7, 0.5, 0.6}),
                                  normalized({-0.3, -0.4, -0.8})}) {
                const Vec3d o = direction_at(angle_o);
                const Mean f = mean_of(evaluate(scene, {o}, std::vector<Vec3d>(4'000, i)), [](const BsdfDraw& s) { return s.evaluated; });
                const bool transmits = bsdf.spec_trans.value > 0.0f;
                const double expected = transmits || (o.z > 0.0 && i.z > 0.0) ? model(in_tangent_frame(o), in_tangent_frame(i)) : 0.0;
                EXPECT_NEAR(f.value, expected, 4.5 * f.error + 2e-4 * expected) << o.z << " from " << i.z << ", eta " << bsdf.eta;
            }
        }
    }
}

// What paths carry on by all lobes together is the integral of the model.
TEST_F(PrincipledLobes, CarryTheIntegralOfTheModel)
{
    constexpr int rows = 400, columns = 200; // of angles: the coat's peak is 0.15 rad wide
    for (const PrincipledBsdf& bsdf : {mixed(), with(mixed(), 1.4f, 0.0f)}) {
        const PlainPrincipled model(bsdf);
        for (const double angle : {0.1, 0.9, 1.4, pi - 0.5}) {
            const Vec3d o = direction_at(angle);
            if (o.z < 0.0 && bsdf.spec_trans.value == 0.0f) continue;
            double integral = 0.0;
            for (int row = 0; row < (bsdf.spec_trans.value == 0.0f ? rows / 2 : rows); ++row) {
                const double theta = pi * (row + 0.5) / rows, cosine = std::cos(theta), sine = std::sin(theta);
                for (int column = 0; column < columns; ++column) {
                    const double phi = 2.0 * pi * (column + 0.5) / columns;
                    integral += model(in_tangent_frame(o), {sine * std::cos(phi), sine * std::sin(phi), cosine}) * std::abs(cosine) * sine *
                                2.0 * pi * pi / (rows * columns);
                }
            }
            const Mean albedo = mean_of(draw(ProbeScene({BsdfDescription{"", {}, bsdf}.model}), {o}, carries_radiance, 100'000),
                                        [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
            EXPECT_NEAR(albedo.value, integral, 4.5 * albedo.error + 2e-3 * integral) << angle;
            EXPECT_LT(albedo.error, 0.01 * integral); // the test has power, and the lobes are well chosen
        }
    }
}

struct Part {
    const char* name;
    PrincipledBsdf bsdf;
    bool both_sides = false;
};
const std::vector<Part> parts = {{"diffuse", diffuse_part(0.0f, 0.0f)}, {"flat", diffuse_part(1.0f, 0.0f)},
                                 {"sheen", diffuse_part(0.0f, 1.0f)},   {"metal", metal_part(0.6f, 0.0f)},
                                 {"brushed", metal_part(0.7f, 0.6f)},   {"coat", coat_part(0.0f)},
                                 {"glass", glass_part(0.9f), true}};

// Where only one lobe can be chosen, there is no noise.
TEST_F(PrincipledLobes, EachIsItsPartOfTheModel)
{
    const std::vector<Vec3d> directions = DirectionGrid{.rows = 40, .columns = 20}.midpoints(1);
    for (const Part& part : parts) {
        const PlainPrincipled model(part.bsdf);
        for (const double angle : angles) {
            for (const Vec3d o : {direction_at(angle), direction_at(pi - angle)}) {
                if (o.z < 0.0 && !part.both_sides) continue;
                const auto values = evaluate(ProbeScene({BsdfDescription{"", {}, part.bsdf}.model}), {o}, directions);
                for (std::size_t k = 0; k < directions.size(); ++k) {
                    const Vec3d i = directions[k];
                    const double expected = part.both_sides || i.z > 0.0 ? model(in_tangent_frame(o), in_tangent_frame(i)) : 0.0;
                    ASSERT_NEAR(values[k].evaluated, expected, 2e-3 * expected + 1e-6) << part.name << " " << o.z << " from " << i.z;
                }
            }
        }
    }
}

TEST_F(PrincipledLobes, SampleTheirDensity)
{
    constexpr uint count = 60'000;
    constexpr int fine = 12;
    for (const Part& part : parts) {
        const ProbeScene scene({BsdfDescription{"", {}, part.bsdf}.model});
        for (const double angle : angles) {
            for (const Vec3d o : {direction_at(angle), direction_at(pi - angle)}) {
                if (o.z < 0.0 && !part.both_sides) continue;
                // Rows along the normal, so that the horizon is an edge of bins.
                const DirectionGrid grid{.rows = 40, .columns = 24};
                const std::vector<Vec3d> midpoints = grid.midpoints(fine);
                std::vector<float> densities;
                for (const BsdfDraw& s : evaluate(scene, {o}, midpoints)) densities.push_back(static_cast<float>(s.evaluated_pdf));
                std::vector<Vec3d> directions;
                for (const BsdfDraw& s : draw(scene, {o}, carries_radiance, count)) {
                    if (s.absorbed()) continue;
                    // The grid has no digits within 1e-3 of the horizon: a direction counts on its own side.
                    Vec3d d = s.direction;
                    if (std::abs(d.z) < 1e-3) d = normalized({d.x, d.y, (s.eta_scale == 1.0) == (o.z > 0.0) ? 2e-3 : -2e-3});
                    directions.push_back(d);
                    if (s.pdf < 1e-3 || std::abs(d.z) < 0.01) continue;
                    ASSERT_NEAR(s.evaluated_pdf / s.pdf, 1.0, 1e-2) << part.name << " from " << angle;
                    ASSERT_NEAR(s.weight.x, s.evaluated * std::abs(d.z) / s.pdf, 1e-2 * (s.weight.x + 0.1))
                        << part.name << " from " << angle;
                }
                std::vector<double> observed = grid.count(directions), expected = grid.expected(densities, fine, count);
                EXPECT_TRUE(follows(observed, expected, static_cast<int>(parts.size() + 1) * 4, 2e-2)) << part.name << " from z = " << o.z;
            }
        }
    }
}

// f(i, o) = f(o, i); of radiance one way and flux the other way where light is refracted [Veach 1997, eq. 5.14].
TEST_F(PrincipledLobes, AreReciprocal)
{
    const std::vector<Vec3d> directions = {direction_at(0.3), normalized({-0.5, 0.2, 0.4}), normalized({0.1, -0.8, 0.1}),
                                           normalized({0.2, 0.1, -0.9}), normalized({-0.4, 0.1, -0.7})};
    for (const Part& part : parts) {
        const ProbeScene scene({BsdfDescription{"", {}, part.bsdf}.model});
        for (const Vec3d a : directions) {
            for (const Vec3d b : directions) {
                if ((a.z < 0.0 || b.z < 0.0) && !part.both_sides) continue;
                const double forth = evaluate(scene, {a}, {b}, carries_radiance)[0].evaluated;
                const double back = evaluate(scene, {b}, {a}, carries_flux)[0].evaluated;
                EXPECT_NEAR(forth, back, 1e-3 * std::abs(forth) + 1e-6) << part.name << " " << a.z << " and " << b.z;
                EXPECT_TRUE(forth > 0.0 || a.z * b.z < 0.0) << part.name;
            }
        }
    }
}

// Facets and coat send on no more than they get. The diffuse part, sheen and flatness do not keep to that: see below.
TEST_F(PrincipledLobes, FacetsMakeNoLight)
{
    for (const PrincipledBsdf& bsdf : {metal_part(0.3f, 0.0f), metal_part(1.0f, 0.0f), metal_part(0.7f, 1.0f), coat_part(0.0f),
                                       coat_part(1.0f), glass_part(0.3f), glass_part(1.0f)}) {
        const ProbeScene scene({BsdfDescription{"", {}, bsdf}.model});
        for (const double angle : angles) {
            const Mean albedo = mean_of(draw(scene, {direction_at(angle)}, carries_flux, 20'000),
                                        [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
            EXPECT_LT(albedo.value, 1.0 + 4.5 * albedo.error + 1e-4) << angle << ", roughness " << bsdf.roughness.value;
        }
    }
}

} // namespace
} // namespace sundog
