// shade_photon_path against plain C++, vertex by vertex along real light paths, with photons straight from lights and without,
// and for each choice of photons.
#include "kernels/shading_fixture.h"

namespace sundog
{
namespace
{

class ShadePhotonPath : public ShadingStage
{
protected:
    // As if the paths had had so many edges before they set out.
    void follow(bool direct_light, uint edges_before = 0, int kept = PHOTONS_ALL)
    {
        start_light_paths();
        auto states = paths_.download();
        for (PathState& state : states) state.depth += edges_before;
        paths_.upload(states);
        auto deposits = allocate<Photon>(light_paths);
        std::vector<Photon> got;
        BuildOptions options = options_;
        options.defines.emplace_back("DIRECT_LIGHT", direct_light ? "1" : "0");
        options.defines.emplace_back("PHOTONS_KEPT", std::to_string(kept));
        const Kernel shade(device_, "shade_photon_path", "Shade", options);
        follow_paths(
            [&](std::size_t items) {
                deposits.upload(std::vector<Photon>(light_paths, {{0, 0, 0}, untouched_flag, {0, 0, 0}, 0}));
                shade(items, scene_.surfaces(), key_, rules(), light_paths, hits_, active_, active_count_, rays_, paths_, deposits, flags_);
                got = deposits.download();
            },
            [&](std::size_t item, uint path, const PlainVertex& vertex) {
                Doubt doubt;
                const PlainOutcome expected = plain_photon_vertex(plain_, vertex, rules(), direct_light, light_numbers(path), doubt, kept);
                if (!is_certain(vertex, expected, doubt)) return;
                expect_step(item, path, expected.next, expected.leaves_record ? PATH_DEPOSIT : 0);
                if (expected.leaves_record) expect_marked_photon(path, vertex, expected, got[item]);
                if (expected.next && kept != PHOTONS_ALL) {
                    const uint before = vertex.path.flags & PATH_SCATTERED_BROADLY;
                    const uint here = expected.side->specular() ? 0 : PATH_SCATTERED_BROADLY;
                    EXPECT_EQ(next_paths_[path].flags & PATH_SCATTERED_BROADLY, before | here) << "path " << path;
                }
            });
        expect_few_in_doubt();
        if (GetParam().complete) expect_seen({"records"});
        if (kept != PHOTONS_CAUSTIC) expect_all_surfaces_seen(); // its paths are short
    }

    static void expect_marked_photon(uint path, const PlainVertex& vertex, const PlainOutcome& expected, const Photon& photon)
    {
        expect_photon(path, vertex, *expected.surface, expected.flux, photon);
        // Only specular vertices since a point or a direction.
        const bool unreached = (vertex.path.flags & PATH_FROM_DELTA_LIGHT) != 0 && vertex.path.scattered == 0;
        EXPECT_EQ((photon.normal_depth & PHOTON_UNREACHED) != 0, unreached) << "path " << path;
    }
};

TEST_P(ShadePhotonPath, WithDirectLightDoesAsPlainCode)
{
    follow(true);
}

TEST_P(ShadePhotonPath, WithoutDirectLightDoesAsPlainCode)
{
    follow(false);
}

// The seven bits that photons have for their edges do not hold those of some of these paths.
TEST_P(ShadePhotonPath, LongPathsDoAsPlainCode)
{
    follow(true, 124);
}

TEST_P(ShadePhotonPath, LongestPathsDoAsPlainCode)
{
    follow(true, PHOTON_DEEP + PHOTON_MOST_BEYOND - 2);
}

TEST_P(ShadePhotonPath, CausticPhotonsAreAsInPlainCode)
{
    follow(true, 0, PHOTONS_CAUSTIC);
}

TEST_P(ShadePhotonPath, ScatteredPhotonsAreAsInPlainCode)
{
    follow(false, 0, PHOTONS_SCATTERED);
}

INSTANTIATE_TEST_SUITE_P(Rules, ShadePhotonPath, testing::ValuesIn(shading_cases()), case_name);

} // namespace
} // namespace sundog
