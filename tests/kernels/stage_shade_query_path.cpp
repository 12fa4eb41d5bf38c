// shade_query_path against plain C++, vertex by vertex along real paths, with and without next-event estimation.
#include "kernels/shading_fixture.h"
#include "shared/photon.h"

namespace sundog
{
namespace
{

class ShadeQueryPath : public ShadingStage
{
protected:
    static constexpr float radius = 0.0625f;

    void follow(bool direct_light)
    {
        start_camera_paths();
        auto queries = allocate<GatherQuery>(pixels_.size());
        const auto lobes = allocate<LobeRecord>(1);
        std::vector<GatherQuery> got;
        BuildOptions options = options_;
        options.defines.emplace_back("DIRECT_LIGHT", direct_light ? "1" : "0");
        const Kernel shade(device_, "shade_query_path", "Shade", options);
        follow_paths(
            [&](std::size_t items) {
                queries.upload(std::vector<GatherQuery>(pixels_.size(), {{0, 0, 0}, untouched, {0, 0, 0}, 0, {0, 0, 0}, 0}));
                shade(items, scene_.surfaces(), key_, rules(), radius, 0.0f, hits_, active_, active_count_, rays_, paths_, radiance_,
                      shadow_rays_, shadow_radiance_, queries, lobes, flags_);
                got = queries.download();
            },
            [&](std::size_t item, uint path, const PlainVertex& vertex) {
                Doubt doubt;
                const PlainOutcome expected = plain_query_vertex(plain_, vertex, rules(), direct_light, camera_numbers(path), doubt);
                if (!is_certain(vertex, expected, doubt)) return;
                expect_step(item, path, expected.next);
                if (direct_light) expect_shadow(path, expected.shadow, &got_shadow_radiance_[path]);
                expect_radiance(path, expected.radiance);
                expect_query(path, vertex, expected, got[path], radius);
            });
        expect_few_in_doubt();
        expect_all_surfaces_seen();
        if (direct_light) expect_all_lights_seen();
        if (GetParam().complete) expect_seen({"records", "type 0 seen", "type 1 seen", "type 2 seen"});
    }
};

TEST_P(ShadeQueryPath, WithDirectLightDoesAsPlainCode)
{
    follow(true);
}

TEST_P(ShadeQueryPath, WithoutDirectLightDoesAsPlainCode)
{
    follow(false);
}

INSTANTIATE_TEST_SUITE_P(Rules, ShadeQueryPath, testing::ValuesIn(shading_cases()), case_name);

} // namespace
} // namespace sundog
