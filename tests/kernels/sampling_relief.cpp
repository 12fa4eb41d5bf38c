// Lobes about the normals of maps of normals and heights: the normal is the one that the map says, samples follow their
// density about it, and weights are those of f, the cosine to it and the shadows of the relief.
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"

namespace sundog
{
namespace
{

using std::numbers::pi;
using Model = decltype(BsdfDescription::model);

const Vec3d dpdu(1.0, 0.5, 0.0), dpdv(-0.5, 1.0, 0.0); // the probe's surface; its normal is z, its uv (0.25, 0.5)

struct Relief {
    const char* name;
    bool bumps;
    bool shadows;
};

// Printed by name.
void PrintTo(const Relief& relief, std::ostream* out)
{
    *out << relief.name;
}

// x, y, z as a map of normals has them, along u, v and z.
const Vec3d mapped(0.5, -0.3, 0.7);

Vec3d turned_normal(const Relief& relief)
{
    if (relief.bumps) {
        // Heights 0.1 and 0.9 above, 0.5 and 0.2 below, 2 x 2 texels, scaled by 0.3. At u = 1/4, a texel's centre, and v =
        // 1/2, halfway between the rows, slopes are 2 ((0.9 - 0.1) + (0.2 - 0.5)) / 2 along u and 2 (0.5 - 0.1) along v.
        const double along_u = 0.3 * 0.5, along_v = 0.3 * 0.8;
        return normalized(cross(dpdu + Vec3d(0, 0, along_u), dpdv + Vec3d(0, 0, along_v)));
    }
    const Vec3d s = normalized(dpdu);
    return normalized(s * mapped.x + cross(Vec3d(0, 0, 1), s) * mapped.y + Vec3d(0, 0, 1) * mapped.z);
}

ProbeScene scene_with(const Relief& relief, const Model& nested)
{
    if (!relief.bumps) {
        const auto half = [](double x) { return static_cast<float>(0.5 * x + 0.5); };
        return ProbeScene({nested, NormalMapBsdf{{half(mapped.x), half(mapped.y), half(mapped.z)}, false, relief.shadows, 0}});
    }
    ProbeScene scene({nested, BumpMapBsdf{NumberSource(0.3f, 0), false, relief.shadows, 0}});
    Texture texture{};
    texture.type = TEXTURE_BITMAP;
    texture.width = texture.height = 2;
    texture.format = TEXELS_HALF;
    texture.wrap_u = texture.wrap_v = WRAP_CLAMP;
    texture.filter = FILTER_BILINEAR;
    texture.to_u[0] = texture.to_v[1] = 1.0f;
    scene.textures = {texture};
    for (const uint half : {0x2e66u, 0x3b33u, 0x3800u, 0x3266u}) { // 0.1, 0.9, 0.5, 0.2
        scene.texels.push_back(half | half << 16);
        scene.texels.push_back(half);
    }
    return scene;
}

// By the fraction of light that reliefs of the same mean slope let pass [Estevez et al. 2019].
double shadowing(Vec3d normal, Vec3d light)
{
    const auto tan2 = [](Vec3d v) { return 1.0 / (v.z * v.z) - 1.0; };
    return 2.0 / (1.0 + std::sqrt(1.0 + std::min(1.0, 0.125 * tan2(normal)) * tan2(light)));
}

struct Nested {
    const char* name;
    Model model;
};

std::vector<Nested> nested_lobes()
{
    const Roughness rough{false, 0.5f, 0.8f};
    PrincipledBsdf cloth;
    cloth.eta = 1.0f;
    cloth.sheen = 1.0f;
    PrincipledBsdf metal;
    metal.metallic = 1.0f;
    metal.roughness = 0.8f;
    PlasticBsdf base;
    base.specular_reflectance = ColorSource(0.0f, 0.0f, 0.0f);
    return {{"diffuse", DiffuseBsdf{{1, 1, 1}}},
            {"metal", ConductorBsdf{{0, 0, 0}, {1, 1, 1}, {}, rough}},
            {"glass", DielectricBsdf{1.5f, 1.0f, false, {}, {}, Roughness{false, 0.8f, 0.8f}}},
            {"plastic", base},
            {"cloth", cloth},
            {"principled metal", metal},
            {"phong", PhongBsdf{{0, 0, 0}, {1, 1, 1}, 10.0f}}};
}

class ReliefLobes : public BsdfProbe, public testing::WithParamInterface<Relief>
{
};

TEST_P(ReliefLobes, SamplesFollowTheirDensity)
{
    constexpr uint count = 50'000;
    constexpr int fine = 16;
    const Vec3d normal = turned_normal(GetParam());
    const DirectionGrid grid{.rows = 40, .columns = 24};
    const std::vector<Vec3d> midpoints = grid.midpoints(fine);
    for (const Nested& nested : nested_lobes()) {
        const ProbeScene scene = scene_with(GetParam(), nested.model);
        for (const double angle : {0.2, 1.1}) {
            const Vec3d o = direction_at(angle);
            std::vector<float> densities; // what goes through the face is absorbed, though it has a density
            for (const BsdfDraw& s : evaluate(scene, {o}, midpoints))
                densities.push_back(s.evaluated > 0.0 ? static_cast<float>(s.evaluated_pdf) : 0.0f);
            std::vector<Vec3d> directions;
            for (const BsdfDraw& s : draw(scene, {o}, carries_radiance, count)) {
                if (s.absorbed()) continue;
                const double cosine = std::abs(dot(s.direction, normal));
                const bool crosses = s.eta_scale != 1.0;
                Vec3d d = s.direction;
                if (std::abs(d.z) < 1e-3) d = normalized({d.x, d.y, crosses ? -2e-3 : 2e-3});
                directions.push_back(d);
                if (s.pdf < 1e-3 || cosine < 0.01 || std::abs(d.z) < 0.01) continue;
                ASSERT_NEAR(s.evaluated_pdf / s.pdf, 1.0, 1e-2) << nested.name << " from " << angle;
                ASSERT_NEAR(s.weight.x, s.evaluated * cosine / s.pdf, 1e-2 * (s.weight.x + 0.1)) << nested.name << " from " << angle;
            }
            std::vector<double> observed = grid.count(directions), expected = grid.expected(densities, fine, count);
            EXPECT_TRUE(follows(observed, expected, 2 * 2 * 7, 2e-2)) << nested.name << " from " << angle;
        }
    }
}

// A white diffuse lobe says all: 1 / pi on the front of the turned normal, nothing behind it or the face, less shadows.
TEST_P(ReliefLobes, TurnTheNormalAndThrowShadows)
{
    const Vec3d normal = turned_normal(GetParam()), o = direction_at(0.2);
    const ProbeScene scene = scene_with(GetParam(), DiffuseBsdf{{1, 1, 1}});
    const std::vector<Vec3d> midpoints = DirectionGrid{.rows = 60, .columns = 60}.midpoints(1);
    const auto values = evaluate(scene, {o}, midpoints);
    for (std::size_t k = 0; k < midpoints.size(); ++k) {
        const Vec3d i = midpoints[k];
        const double cosine = dot(i, normal);
        if (std::abs(cosine) < 1e-3 || std::abs(i.z) < 1e-3) continue;
        const double expected = cosine > 0.0 && i.z > 0.0 ? (GetParam().shadows ? shadowing(normal, i) : 1.0) / pi : 0.0;
        ASSERT_NEAR(values[k].evaluated, expected, 2e-3 * expected) << i.x << " " << i.y << " " << i.z;
        ASSERT_NEAR(values[k].evaluated_pdf, std::max(cosine, 0.0) / pi, 1e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(Maps, ReliefLobes,
                         testing::Values(Relief{"Normals", false, false}, Relief{"ShadowedNormals", false, true},
                                         Relief{"Bumps", true, true}),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace sundog
