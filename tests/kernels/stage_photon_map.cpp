// The photon map against a search through all photons: dense and hashed grids, borders, corners, collisions, and what
// a query must leave out.
#include "support/device_fixture.h"
#include "support/photon_cloud.h"

namespace sundog
{
namespace
{

class PhotonMapStage : public DeviceFixture
{
protected:
    // Every query must find what a search through all photons finds. Returns how many photons were found in all.
    double expect_brute_force(PhotonCloud& cloud, const std::vector<Photon>& photons, const std::vector<GatherQuery>& queries,
                              double margin = 1e-5)
    {
        double found = 0.0;
        const auto sums = cloud.gather(gather_, queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const BruteForce expected = brute_force(photons, queries[i], margin);
            EXPECT_GE(sums[i].count, expected.least_count) << "query " << i << " misses photons";
            EXPECT_LE(sums[i].count, expected.most_count) << "query " << i << " counts photons twice, or too far ones";
            EXPECT_GE(sums[i].flux.x, expected.least_flux * (1.0 - 1e-5)) << "query " << i;
            EXPECT_LE(sums[i].flux.x, expected.most_flux * (1.0 + 1e-5)) << "query " << i;
            if (HasFailure()) return found;
            found += sums[i].count;
        }
        return found;
    }

    std::mt19937 random_{7};
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    Vec3 point(const Bounds& box)
    {
        return {uniform(box.lower.x, box.upper.x), uniform(box.lower.y, box.upper.y), uniform(box.lower.z, box.upper.z)};
    }

    // Half spread through the box, half crowded about a point of it.
    std::vector<Photon> crowd(const Bounds& box, std::size_t count, float spread)
    {
        std::vector<Photon> photons;
        const Vec3 center = point(box);
        for (std::size_t i = 0; i < count; ++i) {
            Vec3 position = point(box);
            if (i % 2 == 0)
                position = max(box.lower,
                               min(box.upper, center + Vec3{uniform(-spread, spread), uniform(-spread, spread), uniform(-spread, spread)}));
            photons.push_back(make_test_photon(position, {uniform(0.5f, 1.5f), 1, 1}));
        }
        return photons;
    }

    // Queries at and about photons.
    std::vector<GatherQuery> queries_near(const std::vector<Photon>& photons, std::size_t count, float radius)
    {
        std::vector<GatherQuery> queries;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 at = photons[random_() % photons.size()].position;
            queries.push_back(make_test_query(at + Vec3{uniform(-radius, radius), uniform(-radius, radius), uniform(-radius, radius)} *
                                                       static_cast<float>(i % 3),
                                              radius));
        }
        return queries;
    }

    PhotonGather<> gather_{device_, 4096, "estimators/flux_sum.h", 0};
};

const Bounds unit_box{{0, 0, 0}, {1, 1, 1}};

TEST_F(PhotonMapStage, DenseGrid)
{
    const auto photons = crowd(unit_box, 20'000, 0.1f);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build(photons, 0.04f);
    ASSERT_EQ(cloud.map.grid().hashed, 0u);
    EXPECT_GT(expect_brute_force(cloud, photons, queries_near(photons, 400, 0.04f)), 10'000.0);
    EXPECT_GT(expect_brute_force(cloud, photons, queries_near(photons, 400, 0.011f)), 400.0) << "radii smaller than the grid's";
}

TEST_F(PhotonMapStage, HashedGrid)
{
    const auto photons = crowd(unit_box, 20'000, 0.005f);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build(photons, 0.002f);
    ASSERT_EQ(cloud.map.grid().hashed, 1u);
    EXPECT_GT(expect_brute_force(cloud, photons, queries_near(photons, 400, 0.002f)), 10'000.0);
}

// Millions of cells in a table of 4096: most entries hold several, and a query's cells share some.
TEST_F(PhotonMapStage, TinyRadiiAndCollisions)
{
    for (const float radius : {1e-3f, 1e-5f, 1e-6f, 4.8e-7f, 3e-8f}) {
        SCOPED_TRACE(radius);
        const auto photons = crowd(unit_box, 3000, 3.0f * radius);
        PhotonCloud cloud(device_, unit_box, photons.size());
        cloud.build(photons, radius);
        ASSERT_EQ(cloud.map.grid().hashed, 1u);
        ASSERT_EQ(cloud.map.grid().cell_count, 4096u);
        // Positions are floats: near the radius of a few ulp nothing is certain but the photons at the query itself.
        EXPECT_GT(expect_brute_force(cloud, photons, queries_near(photons, 2000, radius), 1e-5), 2000.0);
    }
}

// Photons on the borders of cells, queries at almost a radius from them, along all axes and diagonals.
TEST_F(PhotonMapStage, CellBorders)
{
    for (const float radius : {0.0625f, 0.05f, 0.004f}) {
        SCOPED_TRACE(radius);
        PhotonCloud cloud(device_, unit_box, 2000);
        std::vector<Photon> photons;
        std::vector<GatherQuery> queries;
        const int cells = static_cast<int>(0.5f / radius);
        for (int i = 0; i < 1000; ++i) {
            const auto border = [&] {
                return 2.0f * radius * static_cast<float>(static_cast<int>(random_() % static_cast<uint>(cells + 1)));
            };
            const Vec3 at{border(), border(), border()};
            photons.push_back(make_test_photon(at, {1, 1, 1}));
            const Vec3d direction =
                normalized(Vec3d(double(random_() % 3) - 1.0, double(random_() % 3) - 1.0, double(random_() % 3) - 0.9));
            for (const double reach : {-0.9999, -0.5, 0.0, 0.5, 0.9999})
                queries.push_back(make_test_query(to_float(Vec3d(at) + direction * (reach * radius)), radius));
        }
        queries.resize(4000);
        cloud.build(photons, radius);
        EXPECT_GE(expect_brute_force(cloud, photons, queries), 4000.0);
    }
}

TEST_F(PhotonMapStage, CornersAndBeyondThem)
{
    const Bounds box{{-3, 2, 100}, {5, 2.5f, 104}};
    PhotonCloud cloud(device_, box, 64);
    std::vector<Photon> photons;
    std::vector<GatherQuery> queries;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at{corner & 1 ? box.lower.x : box.upper.x, corner & 2 ? box.lower.y : box.upper.y,
                      corner & 4 ? box.lower.z : box.upper.z};
        const Vec3 outwards = (at - box.center()) * 1e-5f;
        for (const Vec3 p : {at, at + outwards, at - outwards}) {
            photons.push_back(make_test_photon(p, {1, 1, 1}));
            queries.push_back(make_test_query(p, 0.1f));
            queries.push_back(make_test_query(p + outwards * 1000.0f, 0.1f));
        }
    }
    cloud.build(photons, 0.1f);
    EXPECT_GE(expect_brute_force(cloud, photons, queries), 3.0 * 24.0);
}

// A plane has no thickness: one layer of cells.
TEST_F(PhotonMapStage, FlatAndFarScenes)
{
    for (const Bounds& box :
         {Bounds{{0, 0, 1}, {10, 10, 1}}, Bounds{{5000, -5000, 20'000}, {5010, -4990, 20'000}}, Bounds{{0, 0, 0}, {0, 0, 0}}}) {
        const auto photons = crowd(box, 5000, 0.5f);
        PhotonCloud cloud(device_, box, photons.size());
        cloud.build(photons, 0.2f);
        EXPECT_GT(expect_brute_force(cloud, photons, queries_near(photons, 300, 0.2f)), 300.0);
    }
}

TEST_F(PhotonMapStage, OtherSidesAndLongPathsAreLeftOut)
{
    std::vector<Photon> photons;
    for (int i = 0; i < 4000; ++i) {
        const Vec3d normal = normalized(Vec3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
        photons.push_back(
            make_test_photon({uniform(0, 0.02f), uniform(0, 0.02f), 0}, {1, 1, 1}, normal, static_cast<uint>(random_() % 256)));
    }
    std::vector<GatherQuery> queries;
    for (int i = 0; i < 500; ++i) {
        const Vec3 normal = to_float(normalized(Vec3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))));
        const uint depths[] = {0, 1, 2, 100, 254, 255, 256, UNBOUNDED_DEPTH};
        queries.push_back(make_test_query({0.01f, 0.01f, 0}, 0.05f, normal, depths[i % 8]));
    }
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build(photons, 0.05f);
    EXPECT_GT(expect_brute_force(cloud, photons, queries), 10'000.0);

    const std::vector<GatherQuery> upside_down = {make_test_query({0.5f, 0.5f, 0.5f}, 0.05f, {0, 0, -1})};
    const std::vector<Photon> above = {make_test_photon({0.5f, 0.5f, 0.5f}, {1, 1, 1}, {0, 0, 1})};
    cloud.build(above, 0.05f);
    EXPECT_EQ(cloud.gather(gather_, upside_down)[0].count, 0.0f);
}

TEST_F(PhotonMapStage, EmptyMapsAndQueriesOfNoRadius)
{
    PhotonCloud cloud(device_, unit_box, 100);
    cloud.build({}, 0.1f);
    EXPECT_EQ(cloud.gather(gather_, {make_test_query({0.5f, 0.5f, 0.5f}, 0.1f)})[0].count, 0.0f);
    cloud.build({make_test_photon({0.5f, 0.5f, 0.5f}, {1, 1, 1})}, 0.1f);
    const auto sums = cloud.gather(gather_, {make_test_query({0.5f, 0.5f, 0.5f}, 0.0f), make_test_query({0.5f, 0.5f, 0.5f}, 0.1f)});
    EXPECT_EQ(sums[0].count, 0.0f);
    EXPECT_EQ(sums[0].flux.x, 0.0f);
    EXPECT_EQ(sums[1].count, 1.0f);
}

// Eight photons are read at a time, up to seven beyond the last: what an earlier map left there must not count.
TEST_F(PhotonMapStage, WhatLiesBeyondTheLastPhotonDoesNotCount)
{
    for (const char* estimator : {"estimators/flux_sum.h", "estimators/radiance_estimate.h"}) {
        PhotonGather<> gather(device_, 16, estimator, 1);
        PhotonCloud cloud(device_, unit_box, 64);
        cloud.build(std::vector<Photon>(64, make_test_photon({0.5f, 0.5f, 0.5f}, {NAN, INFINITY, NAN})), 0.1f);
        cloud.build(std::vector<Photon>(3, make_test_photon({0.5f, 0.5f, 0.5f}, {1, 1, 1})), 0.1f);
        const GatherSum sum = cloud.gather(gather, {make_test_query({0.5f, 0.5f, 0.5f}, 0.1f)})[0];
        EXPECT_TRUE(std::isfinite(sum.flux.x) && std::isfinite(sum.flux.y)) << estimator;
        EXPECT_GT(sum.flux.x, 0.0f);
    }
}

// Within a cell photons keep the order they came in, and each arrives whole.
TEST_F(PhotonMapStage, PhotonsAreLaidOutByCellInOrder)
{
    auto photons = crowd(unit_box, 5000, 0.1f);
    for (std::size_t i = 0; i < photons.size(); ++i) photons[i].direction = static_cast<uint>(i);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build(photons, 0.1f);
    const PhotonGrid grid = cloud.map.grid();
    const auto streams = cloud.map.streams().download();
    const auto ends = cloud.map.cell_ends().download(cloud.map.cell_ends_offset(), grid.cell_count);
    const auto stream = [&](uint which, std::size_t i) { return streams[which * grid.stride + i]; };
    std::vector<bool> seen(photons.size(), false);
    for (std::size_t cell = 0, i = 0; cell < ends.size(); ++cell) {
        uint previous = 0;
        for (const std::size_t begin = i; i < ends[cell]; ++i) {
            const uint id = std::bit_cast<uint>(stream(PHOTON_DIRECTION, i));
            ASSERT_TRUE(i == begin || id > previous) << "cell " << cell;
            previous = id;
            ASSERT_FALSE(seen.at(id));
            seen[id] = true;
            const Photon& photon = photons[id];
            ASSERT_EQ(stream(PHOTON_X, i), photon.position.x);
            ASSERT_EQ(stream(PHOTON_Y, i), photon.position.y);
            ASSERT_EQ(stream(PHOTON_Z, i), photon.position.z);
            ASSERT_EQ(stream(PHOTON_RED, i), photon.flux.x);
            ASSERT_EQ(stream(PHOTON_GREEN, i), photon.flux.y);
            ASSERT_EQ(stream(PHOTON_BLUE, i), photon.flux.z);
            ASSERT_EQ(std::bit_cast<uint>(stream(PHOTON_NORMAL_DEPTH, i)), photon.normal_depth);
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(photons.size()));
}

// The same bits whatever the number of groups.
// Maps of many photons are sorted by index, others by moving photons: into the same order, so to the same bits.
TEST_F(PhotonMapStage, LargeMapsAreSortedAlike)
{
    const auto photons = crowd(unit_box, 20'000, 0.1f);
    const auto queries = queries_near(photons, 400, 0.04f);
    PhotonCloud small(device_, unit_box, photons.size()), large(device_, unit_box, (std::size_t(1) << 21) + 1);
    small.build(photons, 0.04f);
    large.build(photons, 0.04f);
    const auto expected = small.gather(gather_, queries), found = large.gather(gather_, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        EXPECT_EQ(found[i].count, expected[i].count) << i;
        EXPECT_EQ(found[i].flux.x, expected[i].flux.x) << i;
    }
}

// What is written into lent room is gone with the next map.
TEST_F(PhotonMapStage, LendsItsRoomBetweenMaps)
{
    const auto photons = crowd(unit_box, 5'000, 0.1f);
    const auto queries = queries_near(photons, 100, 0.04f);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build(photons, 0.04f);
    const auto expected = cloud.gather(gather_, queries);
    const std::uint64_t bytes = device_.allocated_bytes();
    Buffer<Photon>& room = cloud.map.lend_room(photons.size());
    EXPECT_EQ(device_.allocated_bytes(), bytes);
    ASSERT_GE(room.size(), photons.size());
    room.upload(std::vector<Photon>(room.size(), make_test_photon({0.5f, 0.5f, 0.5f}, {1e6f, 1, 1})));
    cloud.build(photons, 0.04f);
    const auto found = cloud.gather(gather_, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_EQ(found[i].flux.x, expected[i].flux.x) << i;
    // More than there was: the map makes room, and still answers.
    EXPECT_GE(cloud.map.lend_room(3 * photons.size()).size(), 3 * photons.size());
    cloud.build(photons, 0.04f);
    expect_brute_force(cloud, photons, queries);
}

TEST_F(PhotonMapStage, GroupSizesDoNotMatter)
{
    const auto photons = crowd(unit_box, 10'000, 0.05f);
    const auto queries = queries_near(photons, 1000, 0.03f);
    std::vector<std::uint32_t> first;
    for (const std::size_t group : {1, 16, 64, 256}) {
        device_.set_work_group_size(group);
        PhotonCloud cloud(device_, unit_box, photons.size());
        cloud.build(photons, 0.03f);
        std::vector<std::uint32_t> bits;
        for (const GatherSum& sum : cloud.gather(gather_, queries)) {
            bits.push_back(std::bit_cast<std::uint32_t>(sum.flux.x));
            bits.push_back(std::bit_cast<std::uint32_t>(sum.count));
        }
        if (first.empty()) first = bits;
        EXPECT_EQ(bits, first) << "groups of " << group;
    }
}

} // namespace
} // namespace sundog
