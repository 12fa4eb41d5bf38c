// shade_camera_path against plain C++, vertex by vertex along real paths.
#include "kernels/shading_fixture.h"
#include "shared/regularization.h"

namespace sundog
{
namespace
{

using ShadeCameraPath = ShadingStage;

TEST_P(ShadeCameraPath, DoesAsPlainCode)
{
    start_camera_paths();
    const Kernel shade(device_, "shade_camera_path", "Shade", options_);
    follow_paths(
        [&](std::size_t items) {
            shade(items, scene_.surfaces(), key_, rules(), Regularization{}, hits_, active_, active_count_, rays_, paths_, radiance_,
                  shadow_rays_, shadow_radiance_, flags_);
        },
        [&](std::size_t item, uint path, const PlainVertex& vertex) {
            Doubt doubt;
            const PlainOutcome expected = plain_camera_vertex(plain_, vertex, rules(), camera_numbers(path), doubt);
            if (!is_certain(vertex, expected, doubt)) return;
            expect_step(item, path, expected.next);
            expect_shadow(path, expected.shadow, &got_shadow_radiance_[path]);
            expect_radiance(path, expected.radiance);
        });
    expect_few_in_doubt();
    expect_all_surfaces_seen();
    expect_all_lights_seen();
    if (!GetParam().complete) return;
    expect_seen({"type 0 seen", "type 1 seen", "type 2 seen", "type 0 found", "type 1 found", "type 2 found"}, 10);
    if (GetParam().options.constant_light) expect_seen({"type 6 seen", "type 6 found"});
}

INSTANTIATE_TEST_SUITE_P(Rules, ShadeCameraPath, testing::ValuesIn(shading_cases()), case_name);

} // namespace
} // namespace sundog
