// shade_camera_subpath and shade_light_subpath against plain C++, vertex by vertex along real paths, for each choice of techniques.
#include "kernels/subpath_fixture.h"

namespace sundog
{
namespace
{

class ShadeCameraSubpath : public SubpathStage
{
protected:
    void follow(const Techniques& techniques)
    {
        const std::size_t joinable = follow_camera_subpaths(techniques).size();
        expect_few_in_doubt();
        expect_all_surfaces_seen();
        if (!GetParam().complete) return;
        EXPECT_GE(joinable, 1000u);
        expect_seen({"type 0 seen", "type 1 seen", "type 2 seen", "type 0 found", "type 1 found", "type 2 found"}, 10);
        if (GetParam().options.constant_light) expect_seen({"type 6 seen", "type 6 found"});
        if (techniques.connect > 0.0f) expect_all_lights_seen();
    }
};

TEST_P(ShadeCameraSubpath, WithVertexMergingDoesAsPlainCode)
{
    follow(vertex_merging);
}

TEST_P(ShadeCameraSubpath, WithOtherTechniquesDoesAsPlainCode)
{
    if (!GetParam().complete) return; // rules that end paths early are the same for all
    for (const Techniques& techniques : {connections_alone, merging_alone, gathering}) follow(techniques);
}

class ShadeLightSubpath : public SubpathStage
{
protected:
    void follow(const Techniques& techniques)
    {
        const std::size_t joinable = follow_light_subpaths(techniques).size();
        expect_few_in_doubt();
        expect_all_surfaces_seen();
        if (!GetParam().complete) return;
        if (techniques.merge > 0.0f) expect_seen({"records"}, 1000);
        if (techniques.connect == 0.0f) return;
        EXPECT_GE(joinable, 1000u);
        expect_seen({"splats"}, 500);
    }
};

TEST_P(ShadeLightSubpath, WithVertexMergingDoesAsPlainCode)
{
    follow(vertex_merging);
}

TEST_P(ShadeLightSubpath, WithOtherTechniquesDoesAsPlainCode)
{
    if (!GetParam().complete) return;
    for (const Techniques& techniques : {connections_alone, merging_alone, gathering}) follow(techniques);
}

INSTANTIATE_TEST_SUITE_P(Rules, ShadeCameraSubpath, testing::ValuesIn(shading_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Rules, ShadeLightSubpath, testing::ValuesIn(shading_cases()), case_name);

} // namespace
} // namespace sundog
