// Importance maps: which photons survive, with what probability, and with what flux.
#include "scene/scene.h"
#include "stages/importance_map.h"
#include "stages/sampling.h"
#include "support/cornell_scene.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"

namespace sundog
{
namespace
{

class Importance : public DeviceFixture
{
protected:
    std::mt19937 random_{3};
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    Vec3 on_floor(float low, float high) { return {uniform(low, high), -1.0f, uniform(-1, 1)}; }
};

// Importons on half of the floor, photons on all of it: there all survive, on the other half a tenth, ten times as strong.
TEST_F(Importance, PhotonsSurviveWhereImportonsAre)
{
    const DeviceScene scene(device_, test::cornell_box(16));
    constexpr std::size_t batch = 1000; // the photons are no multiple of it
    constexpr std::size_t count = 40'500;
    ImportanceMap importance(device_, scene, batch, 4 * batch, 0.1f);
    for (int i = 0; i < 4; ++i) {
        std::vector<GatherQuery> queries;
        for (std::size_t q = 0; q < batch; ++q) {
            // Every second asks nothing, where it could mislead.
            queries.push_back(q % 2 ? make_test_query(on_floor(0.2f, 1.0f), 0.0f, {0, 1, 0})
                                    : make_test_query(on_floor(-1.0f, 0.0f), 0.1f, {0, 1, 0}));
        }
        importance.add(upload(queries));
    }
    importance.build();
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < count; ++i) {
        photons.push_back(make_test_photon(on_floor(-0.85f, 0.85f), {uniform(0.5f, 1.5f), 1, static_cast<float>(i)}, {0, 1, 0}));
        photons.back().direction = static_cast<uint>(i);
    }
    RecordList<Photon> records(device_, "photons", count);
    records.assign(photons);
    const auto survivors = importance.thin(records, count, sampler_key(9, 5));
    double near_all = 0.0, near = 0.0, far_all = 0.0, far = 0.0;
    for (const Photon& photon : photons) {
        near_all += photon.position.x < -0.15f ? 1.0 : 0.0;
        far_all += photon.position.x > 0.15f ? 1.0 : 0.0;
    }
    long previous = -1;
    for (const Photon& photon : survivors) {
        const Photon& before = photons[photon.direction];
        ASSERT_GT(static_cast<long>(photon.direction), previous) << "order";
        previous = static_cast<long>(photon.direction);
        ASSERT_EQ(photon.position, before.position);
        ASSERT_EQ(photon.normal_depth, before.normal_depth);
        const bool is_far = photon.position.x > 0.15f;
        far += is_far ? 1.0 : 0.0;
        near += photon.position.x < -0.15f ? 1.0 : 0.0;
        const double gain = photon.flux.y;
        EXPECT_NEAR(photon.flux.x, before.flux.x * gain, 1e-5 * gain);
        if (is_far) {
            EXPECT_FLOAT_EQ(photon.flux.y, 10.0f);
        }
        EXPECT_GE(gain, 1.0);
        EXPECT_LE(gain, 10.001);
    }
    EXPECT_EQ(near, near_all) << "some 31 importons are about each (with 8 or more but for one in a million), and one is enough";
    EXPECT_NEAR(far, 0.1 * far_all, 4.0 * std::sqrt(0.09 * far_all));
    // Another key, other survivors; the same key, the same.
    EXPECT_EQ(importance.thin(records, count, sampler_key(9, 5)).size(), survivors.size());
    EXPECT_NE(importance.thin(records, count, sampler_key(9, 6)).size(), survivors.size());
    EXPECT_NE(importance.thin(records, count, sampler_key(10, 5)).size(), survivors.size());
    records.assign({});
    EXPECT_TRUE(importance.thin(records, 0, sampler_key(9, 5)).empty());
}

} // namespace
} // namespace sundog
