// connect_vertices and merge_photons against plain C++, between vertices that real subpaths have left.
#include "kernels/subpath_fixture.h"
#include "stages/compaction.h"

#include <random>

namespace sundog
{
namespace
{

std::vector<PathVertex> records_of(const std::vector<JoinableVertex>& vertices)
{
    std::vector<PathVertex> records;
    for (const JoinableVertex& vertex : vertices) records.push_back(vertex.record);
    return records;
}

class ConnectVertices : public SubpathStage
{
protected:
    void connect(const Techniques& techniques)
    {
        constexpr uint count = 20'000;
        constexpr float scale = 1.75f;
        const auto seen = follow_camera_subpaths(techniques), lit = follow_light_subpaths(techniques);
        ASSERT_FALSE(seen.empty());
        ASSERT_FALSE(lit.empty());
        std::mt19937 random(11);
        std::vector<VertexPair> pairs(count);
        for (VertexPair& pair : pairs) {
            pair.path = static_cast<uint>(random() % seen.size());
            pair.slot = random() % 20 == 0 ? NO_VERTEX : static_cast<uint>(random() % lit.size());
        }
        shadow_rays_ = upload(std::vector<Ray>(count, {{0, 0, 0}, untouched, {0, 0, 0}, 0}));
        auto brought = upload(std::vector<Vec3>(count, {untouched, untouched, untouched}));
        Kernel(device_, "connect_vertices", "Connect", options_)(count, rules(), scale, count, upload(pairs), upload(records_of(seen)),
                                                                 upload(records_of(lit)), shadow_rays_, brought);
        got_shadow_rays_ = shadow_rays_.download();
        const auto radiance = brought.download();
        int connected = 0, doubtful = 0;
        for (uint i = 0; i < count && !HasFailure(); ++i) {
            Doubt doubt;
            std::optional<PlainShadow> expected;
            if (pairs[i].slot != NO_VERTEX) expected = plain_connection(seen[pairs[i].path], lit[pairs[i].slot], rules(), scale, doubt);
            doubtful += doubt ? 1 : 0;
            if (doubt) continue;
            connected += expected ? 1 : 0;
            expect_shadow(i, expected, &radiance[i]);
        }
        // A third of all pairs lie on one plane, and see each other edge on.
        EXPECT_LE(doubtful, 0.4 * count);
        if (!GetParam().complete) return;
        EXPECT_GE(connected, 1000);
    }
};

TEST_P(ConnectVertices, BringsWhatPlainCodeBrings)
{
    for (const Techniques& techniques : {vertex_merging, connections_alone, gathering}) connect(techniques);
}

class MergePhotons : public SubpathStage
{
protected:
    void merge(const Techniques& techniques, int kernel)
    {
        constexpr float radius = 0.2f;
        auto vertices = follow_camera_subpaths(techniques);
        follow_light_subpaths(techniques);
        std::shuffle(vertices.begin(), vertices.end(), std::mt19937(13));
        vertices.resize(std::min<std::size_t>(vertices.size(), 400));
        std::vector<PathVertex> records = records_of(vertices);
        // Half of them by the way that lobes of any kind take: the flag tells of a normal map, but the normals are the surface's own.
        for (std::size_t i = 0; i < records.size(); i += 2) records[i].lobe.flags |= LOBE_PERTURBED;

        const std::size_t count = vertices.size();
        std::vector<uint> active(count), flags(count);
        std::iota(active.begin(), active.end(), 0u);
        for (std::size_t i = 0; i < count; ++i) flags[i] = i % 10 == 3 ? PATH_ALIVE : PATH_ALIVE | PATH_JOINS;
        PhotonCloud cloud(device_, scene_.bounds(), left_photons_.size() + 1, true);
        cloud.build(left_photons_, radius);
        const uint stride = cloud.map.grid().stride;
        const auto photon_count = upload(std::vector{static_cast<uint>(left_photons_.size())});
        auto weights = allocate<float>(2 * std::size_t(stride));
        Kernel(device_, "reorder_merge_weights", "Lay out")(left_photons_.size(), upload(left_photon_vertices_), cloud.map.order(),
                                                            photon_count, stride, weights);
        radiance_ = upload(std::vector<Vec3>(count, radiance_before));
        BuildOptions options = options_;
        options.defines.emplace_back("DENSITY_KERNEL", std::to_string(kernel));
        Kernel(device_, "merge_photons", "Merge", options)(
            count, cloud.map, weights, rules(), techniques,
            radius, upload(active), upload(std::vector{static_cast<uint>(count)}), upload(flags), upload(records), radiance_);
        got_radiance_ = radiance_.download();
        int certain = 0, lit = 0;
        for (std::size_t i = 0; i < count && !HasFailure(); ++i) {
            Doubt doubt;
            Vec3d expected;
            if (flags[i] & PATH_JOINS)
                expected = plain_merging(vertices[i], left_photons_, left_photon_vertices_, rules(), techniques, radius, kernel, doubt);
            if (doubt) continue;
            ++certain;
            lit += is_black(expected) ? 0 : 1;
            expect_radiance(static_cast<uint>(i), expected);
        }
        if (!GetParam().complete) return;
        EXPECT_GE(certain, 200); // of some hundred photons around a vertex, all lie clear of every limit
        EXPECT_GE(lit, 150);
    }
};

TEST_P(MergePhotons, BringsWhatPlainCodeBrings)
{
    for (int kernel : {0, 1}) merge(vertex_merging, kernel);
    merge(merging_alone, 0);
}

std::vector<ShadingCase> joining_cases()
{
    std::vector<ShadingCase> cases;
    for (const ShadingCase& shading_case : shading_cases())
        if (shading_case.complete || shading_case.name == "FourEdges") cases.push_back(shading_case);
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Rules, ConnectVertices, testing::ValuesIn(joining_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Rules, MergePhotons, testing::ValuesIn(joining_cases()), case_name);

} // namespace
} // namespace sundog
