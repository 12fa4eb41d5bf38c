// emit_light_paths against plain C++: where light of each kind sets out, and with what flux.
#include "kernels/shading_fixture.h"

namespace sundog
{
namespace
{

using EmitLightPaths = ShadingStage;

TEST_P(EmitLightPaths, SetsOutAsPlainCode)
{
    reserve(light_paths);
    const std::vector<Ray> nothing(light_paths, {{0, 0, 0}, untouched, {0, 0, 0}, 0});
    rays_.upload(nothing);
    constexpr uint count = light_paths - 100; // the rest is not asked for
    Kernel(device_, "emit_light_paths", "Emit", options_)(light_paths, scene_.surfaces(), key_, count, rays_, paths_, active_);
    const auto rays = rays_.download();
    const auto paths = paths_.download();
    const auto active = active_.download();
    std::map<uint, int> types;
    int doubtful = 0;
    for (uint path = 0; path < count && !HasFailure(); ++path) {
        Doubt doubt;
        const PlainEmission expected = plain_emission(plain_.flat, PlainNumbers::light(key_, path, count).emission(), doubt);
        EXPECT_EQ(active[path], path);
        EXPECT_EQ(paths[path].pdf_w, PDF_DELTA);
        EXPECT_EQ(paths[path].depth, 1u);
        EXPECT_EQ(paths[path].scattered, 0u);
        EXPECT_EQ(paths[path].eta_scale, 1.0f);
        EXPECT_EQ(rays[path].t_max, INFINITY);
        if (doubt) {
            ++doubtful;
            continue;
        }
        ++types[expected.type];
        expect_near("origin", path, rays[path].origin, expected.ray.origin, point_error);
        expect_near("direction", path, rays[path].direction, expected.ray.direction, direction_error);
        expect_colour("flux", path, paths[path].throughput, expected.flux);
    }
    for (uint path = count; path < light_paths; ++path) EXPECT_EQ(rays[path].t_max, untouched);
    for (uint type = LIGHT_TRIANGLE; type <= LIGHT_CONSTANT; ++type)
        EXPECT_EQ(types[type] > 100, type != LIGHT_CONSTANT || GetParam().options.constant_light)
            << "light type " << type << ": " << types[type];
    // Grazing directions (cos < 0.03: a share of 0.001) and a spot's edge (the outer 1 % of the fall-off: 0.02 of spots).
    EXPECT_LT(doubtful, 0.01 * count);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EmitLightPaths, testing::ValuesIn(std::vector{shading_cases()[0], shading_cases()[1]}), case_name);

} // namespace
} // namespace sundog
