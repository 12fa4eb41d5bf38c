// add_visible_light against plain C++: what the camera sees of the lights themselves.
#include "kernels/shading_fixture.h"

namespace sundog
{
namespace
{

using AddVisibleLight = ShadingStage;

// Emission at its full, times the filter's weight, which may be negative.
TEST_P(AddVisibleLight, DoesAsPlainCode)
{
    start_camera_paths();
    activate_all(pixels_.size());
    trace();
    const uint count = static_cast<uint>(pixels_.size()) - 100; // the rest is not asked for
    Kernel(device_, "add_visible_light", "Add")(pixels_.size(), scene_.surfaces(), count, rays_, hits_, paths_, radiance_);
    const auto rays = rays_.download();
    const auto hits = hits_.download();
    const auto paths = paths_.download();
    got_radiance_ = radiance_.download();
    for (uint path = 0; path < pixels_.size() && !HasFailure(); ++path) {
        Doubt doubt;
        PlainOutcome expected;
        const PlainVertex vertex{rays[path], hits[path], paths[path]};
        if (path < count) start_camera_vertex(plain_, vertex, {1, 1}, 0.0, expected, doubt);
        if (is_certain(vertex, expected, doubt)) expect_radiance(path, expected.radiance);
    }
    expect_few_in_doubt();
    expect_seen({"type 0 seen", "type 2 seen", "misses"});
    expect_seen({"type 1 seen"}, 15.0); // lies on some thirty pixels
    if (GetParam().options.constant_light) expect_seen({"type 6 seen"});
}

INSTANTIATE_TEST_SUITE_P(Scenes, AddVisibleLight, testing::ValuesIn(std::vector{shading_cases()[0], shading_cases()[1]}), case_name);

} // namespace
} // namespace sundog
