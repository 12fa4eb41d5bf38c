// shade_splat_path against plain C++, vertex by vertex along real light paths.
#include "kernels/shading_fixture.h"
#include "shared/film.h"

namespace sundog
{
namespace
{

using ShadeSplatPath = ShadingStage;

TEST_P(ShadeSplatPath, DoesAsPlainCode)
{
    start_light_paths();
    const auto filter = upload(std::vector{plain_.filter});
    const auto pixels = pixels_by_path(plain_.camera.crop_width, plain_.camera.crop_height);
    auto deposits = allocate<Splat>(light_paths);
    std::vector<Splat> got;
    const Kernel shade(device_, "shade_splat_path", "Shade", options_);
    follow_paths(
        [&](std::size_t items) {
            deposits.upload(std::vector<Splat>(light_paths, {{0, 0, 0}, untouched_flag}));
            shade(items, scene_.surfaces(), plain_.camera, filter, key_, rules(), light_paths, hits_, active_, active_count_, rays_, paths_,
                  shadow_rays_, deposits, flags_);
            got = deposits.download();
        },
        [&](std::size_t item, uint path, const PlainVertex& vertex) {
            Doubt doubt;
            std::optional<PlainSplat> splat;
            const PlainOutcome expected = plain_splat_vertex(plain_, vertex, rules(), light_numbers(path), splat, doubt);
            if (!is_certain(vertex, expected, doubt)) return;
            expect_step(item, path, expected.next);
            expect_shadow(path, expected.shadow, splat ? &got[item].radiance : nullptr);
            if (!splat) return;
            ASSERT_LT(got[item].pixel, pixels.size());
            EXPECT_EQ(pixels[got[item].pixel], splat->pixel) << "path " << path;
            const PlainSurface& surface = *expected.surface;
            if (length(surface.shading_normal - surface.geometric_normal) > 0.1) ++seen_["smooth splats"];
            ++seen_[got[item].radiance.x < 0.0f ? "negative splats" : "splats"];
        });
    expect_few_in_doubt();
    expect_all_surfaces_seen();
    if (!GetParam().complete) return;
    expect_seen({"splats"}, 500);
    expect_seen({"smooth splats"}, 100);
    if (GetParam().options.filter == FilterKind::mitchell) expect_seen({"negative splats"});
}

INSTANTIATE_TEST_SUITE_P(Rules, ShadeSplatPath, testing::ValuesIn(shading_cases()), case_name);

} // namespace
} // namespace sundog
