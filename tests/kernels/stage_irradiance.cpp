// Precomputed irradiance: queries at photons, and finding the nearest place with a similar normal among all.
#include "stages/precomputed_irradiance.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"

namespace sundog
{
namespace
{

const Bounds unit_box{{0, 0, 0}, {1, 1, 1}};

class Irradiance : public DeviceFixture
{
protected:
    std::mt19937 random_{5};
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    Vec3d direction() { return normalized(Vec3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))); }

    std::vector<Photon> places(std::size_t count)
    {
        std::vector<Photon> list;
        for (std::size_t i = 0; i < count; ++i) {
            const float id = static_cast<float>(i);
            list.push_back(make_test_photon({uniform(0, 1), uniform(0, 1), uniform(0, 1)}, {id, 2.0f * id, 3.0f * id}, direction()));
        }
        return list;
    }
};

TEST_F(Irradiance, NearestPlaceOfASimilarNormalAnswers)
{
    const float radius = 0.12f;
    const auto list = places(20'000);
    PhotonCloud cloud(device_, unit_box, list.size());
    cloud.build(list, radius);
    std::vector<GatherQuery> queries;
    for (int i = 0; i < 2000; ++i) {
        queries.push_back(make_test_query({uniform(0, 1), uniform(0, 1), uniform(0, 1)}, radius, to_float(direction())));
        queries.back().throughput = {1, 0.5f, 0.25f};
        if (i % 10 == 0) queries.back().flags = QUERY_EVALUATES_LOBE;
        if (i % 10 == 1) queries.back().radius = 0.0f;
    }
    const uint count = static_cast<uint>(queries.size());
    const Buffer<GatherQuery> asked = upload(queries);
    const Buffer<Vec3> radiance = upload(std::vector<Vec3>(count, {7, 7, 7}));
    const Kernel read(device_, "read_irradiance", "Read");
    read(count, cloud.map, radius, count, asked, radiance);
    const auto answered = asked.download();
    const auto found = radiance.download();
    int answers = 0, without = 0, doubtful = 0;
    for (uint i = 0; i < count; ++i) {
        const GatherQuery& query = queries[i];
        double best = radius * radius;
        std::size_t nearest = list.size();
        bool doubt = false;
        for (std::size_t p = 0; p < list.size(); ++p) {
            const Vec3d offset = Vec3d(list[p].position) - Vec3d(query.position);
            const double cosine = dot(unpacked_normal(list[p].normal_depth), Vec3d(query.normal)), square = dot(offset, offset);
            if (square > best * (1.0 + 1e-5)) continue;
            doubt = doubt || std::abs(cosine - 0.9) < 1e-5;
            if (cosine < 0.9 || square >= best) continue;
            best = square;
            nearest = p;
        }
        if (doubt) {
            ++doubtful;
            continue;
        }
        const bool asks = query.radius > 0.0f && query.flags == 0;
        if (!asks || nearest == list.size()) {
            EXPECT_EQ(answered[i].radius, query.radius) << i;
            EXPECT_EQ(found[i], (Vec3{7, 7, 7})) << i;
            without += asks ? 1 : 0;
            continue;
        }
        ++answers;
        const float id = static_cast<float>(nearest);
        EXPECT_EQ(answered[i].radius, 0.0f) << i;
        EXPECT_EQ(found[i], (Vec3{7.0f + id, 7.0f + id, 7.0f + 0.75f * id})) << i;
    }
    EXPECT_GT(answers, 1000);
    EXPECT_GT(without, 10);
    EXPECT_LT(doubtful, 20);
}

TEST_F(Irradiance, PhotonsAskOnTheirSide)
{
    const auto list = places(100);
    const auto queries = allocate<GatherQuery>(64);
    Kernel(device_, "query_photons", "Query")(64, upload(list), 50u, 100u, 0.25f, 64u, queries);
    const auto got = queries.download();
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(got[i].radius, i < 50 ? 0.25f : 0.0f);
        if (i >= 50) continue;
        EXPECT_EQ(got[i].position, list[50 + i].position);
        EXPECT_LT(length(Vec3d(got[i].normal) - unpacked_normal(list[50 + i].normal_depth)), 1e-5);
        EXPECT_EQ(got[i].throughput, (Vec3{1, 1, 1}));
        EXPECT_EQ(got[i].max_photon_depth, UNBOUNDED_DEPTH);
        EXPECT_EQ(got[i].flags, 0u);
    }
}

} // namespace
} // namespace sundog
