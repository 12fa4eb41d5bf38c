// Radii by k nearest photons against sorting all photons, and what the k - 1 nearer ones say of even light.
#include "stages/fixed_photon_map.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"

#include <numbers>

namespace sundog
{
namespace
{

const Bounds unit_box{{0, 0, 0}, {1, 1, 1}};

// Squared distances of the photons that count for a query, in order. Those within rounding of counting are left out of tests.
std::vector<double> sorted_squares(const std::vector<Photon>& photons, const GatherQuery& query)
{
    std::vector<double> squares;
    for (const Photon& photon : photons) {
        if (dot(unpacked_normal(photon.normal_depth), Vec3d(query.normal)) < 0.7) continue;
        if (depth_of(photon) > query.max_photon_depth) continue;
        if ((query.flags & QUERY_UNREACHED_ONLY) && !(photon.normal_depth & PHOTON_UNREACHED)) continue;
        const Vec3d offset = Vec3d(photon.position) - Vec3d(query.position);
        squares.push_back(dot(offset, offset));
    }
    std::sort(squares.begin(), squares.end());
    return squares;
}

class NearestRadii : public DeviceFixture
{
protected:
    std::vector<GatherQuery> find(PhotonCloud& cloud, uint nearest, float first, float largest, const std::vector<GatherQuery>& queries)
    {
        const Kernel kernel(device_, "find_nearest_radii", "Nearest", {{{"NEAREST", std::to_string(nearest) + "u"}}, {}});
        const Buffer<GatherQuery> found = upload(queries);
        const uint count = static_cast<uint>(queries.size());
        kernel(count, cloud.map, first, largest, count,
               found);
        return found.download();
    }

    // Every radius must be the distance to the k-th photon, or the largest. Returns how many were the former.
    double expect_brute_force(PhotonCloud& cloud, const std::vector<Photon>& photons, uint nearest, float first, float largest,
                              const std::vector<GatherQuery>& queries)
    {
        double found = 0.0;
        const auto got = find(cloud, nearest, first, largest, queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const auto squares = sorted_squares(photons, queries[i]);
            const double kth = squares.size() < nearest ? INFINITY : std::sqrt(squares[nearest - 1]);
            const double expected = std::min<double>(kth, largest);
            EXPECT_NEAR(got[i].radius, expected, 3e-6 * expected) << "query " << i << " for " << nearest;
            if (HasFailure()) return found;
            found += kth < largest ? 1.0 : 0.0;
        }
        return found;
    }

    // On the plane z = 1/2, crowded about a point; with all normals that clearly count or clearly do not.
    std::vector<Photon> crowd(std::size_t count)
    {
        std::vector<Photon> photons;
        for (std::size_t i = 0; i < count; ++i) {
            const float spread = i % 2 == 0 ? 0.5f : 0.02f;
            const Vec3 at{0.5f + uniform(-spread, spread), 0.5f + uniform(-spread, spread), 0.5f + uniform(-0.01f, 0.01f)};
            const Vec3d normal = i % 3 == 0 ? Vec3d(0, 0, -1) : normalized(Vec3d(uniform(-0.3f, 0.3f), uniform(-0.3f, 0.3f), 1));
            photons.push_back(make_test_photon(at, {1, 1, 1}, normal, static_cast<uint>(i % 6)));
            if (i % 4 == 0) photons.back().normal_depth |= PHOTON_UNREACHED;
        }
        return photons;
    }

    std::vector<GatherQuery> queries_about(std::size_t count)
    {
        std::vector<GatherQuery> queries;
        for (std::size_t i = 0; i < count; ++i) {
            const float spread = i % 3 == 0 ? 0.6f : 0.05f; // also beyond the box
            queries.push_back(make_test_query({0.5f + uniform(-spread, spread), 0.5f + uniform(-spread, spread), 0.5f}, 1.0f, {0, 0, 1},
                                              i % 2 == 0 ? 3 : UNBOUNDED_DEPTH));
            if (i % 5 == 0) queries.back().flags = QUERY_UNREACHED_ONLY;
        }
        return queries;
    }

    std::mt19937 random_{11};
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
};

TEST_F(NearestRadii, AreDistancesToTheKthPhoton)
{
    const auto photons = crowd(20'000);
    PhotonCloud cloud(device_, unit_box, photons.size());
    for (const float first : {0.003f, 0.02f, 0.3f}) {
        cloud.build_dense(photons, first);
        ASSERT_EQ(cloud.map.grid().hashed, 0u);
        for (const uint nearest : {2u, 50u, 301u}) {
            SCOPED_TRACE(first);
            EXPECT_GT(expect_brute_force(cloud, photons, nearest, first, 0.4f, queries_about(200)), 150.0);
        }
    }
}

TEST_F(NearestRadii, ReachNoFurtherThanTheLargest)
{
    const auto photons = crowd(3000);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build_dense(photons, 0.01f);
    const double found = expect_brute_force(cloud, photons, 20, 0.01f, 0.05f, queries_about(400));
    EXPECT_GT(found, 40.0);
    EXPECT_LT(found, 360.0);
    EXPECT_EQ(expect_brute_force(cloud, photons, 20, 0.01f, 1e-4f, queries_about(100)), 0.0);
    EXPECT_EQ(find(cloud, 20, 0.01f, 0.05f, {make_test_query({0.5f, 0.5f, 0.5f}, 0.0f)})[0].radius, 0.0f) << "not a query";
    cloud.build_dense({}, 0.01f);
    EXPECT_EQ(expect_brute_force(cloud, {}, 2, 0.01f, 0.05f, queries_about(10)), 0.0);
}

// A grid whose cells would be too many for its table is made of wider ones.
TEST_F(NearestRadii, FitEveryTable)
{
    const auto photons = crowd(2000);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build_dense(photons, 1e-6f);
    ASSERT_EQ(cloud.map.grid().hashed, 0u);
    ASSERT_GT(cloud.map.grid().cell_count, 1000u);
    EXPECT_GT(expect_brute_force(cloud, photons, 5, 1e-6f, 0.5f, queries_about(100)), 90.0);
}

// Gathering within the radius found takes the k - 1 nearer photons.
TEST_F(NearestRadii, GatherFindsOneLess)
{
    const auto photons = crowd(20'000);
    PhotonCloud cloud(device_, unit_box, photons.size());
    cloud.build_dense(photons, 0.005f);
    PhotonGather<> gather(device_, 512, "estimators/flux_sum.h", 0, {}, true);
    const auto queries = find(cloud, 40, 0.005f, 10.0f, queries_about(500));
    const auto sums = cloud.gather(gather, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_EQ(sums[i].count, 39.0f) << i;
}

// n even photons a unit area: the k - 1 nearer ones over pi r_k^2 are n in the mean, with the variance n^2 / (k - 2); all k
// would be k / (k - 1) times as many. For every kernel.
TEST_F(NearestRadii, KMinusOneRuleIsExactInTheMean)
{
    constexpr std::size_t count = 160'000;
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < count; ++i) photons.push_back(make_test_photon({uniform(0, 1), uniform(0, 1), 0}, {1, 1, 1}));
    PhotonCloud cloud(device_, unit_box, count);
    cloud.build_dense(photons, 0.01f);
    for (const uint k : {4u, 10u, 20u}) {
        // Queries so far apart that they share no photons.
        std::vector<GatherQuery> queries;
        const double step = 5.0 * std::sqrt(k / (std::numbers::pi * count));
        for (double x = 0.5 * step + 0.02; x < 0.98 - 0.5 * step; x += step)
            for (double y = 0.5 * step + 0.02; y < 0.98 - 0.5 * step; y += step)
                queries.push_back(make_test_query({static_cast<float>(x), static_cast<float>(y), 0}, 1.0f));
        queries = find(cloud, k, 0.01f, 1.0f, queries);
        for (int kernel = 0; kernel < 6; ++kernel) {
            PhotonGather<> gather(device_, queries.size(), "estimators/radiance_estimate.h", kernel, {}, true);
            double mean = 0.0, squares = 0.0;
            const double n = static_cast<double>(queries.size());
            for (const GatherSum& sum : cloud.gather(gather, queries)) {
                const double ratio = sum.flux.x / count;
                mean += ratio / n;
                squares += ratio * ratio / n;
            }
            const double error = std::sqrt((squares - mean * mean) / n);
            EXPECT_NEAR(mean, 1.0, 3.5 * error) << "k = " << k << ", kernel " << kernel; // 18 comparisons: 1% in all
            EXPECT_LT(error, 0.3 / k) << "cannot tell k - 1 from k";
        }
    }
}

TEST_F(NearestRadii, GroupSizesDoNotMatter)
{
    const auto photons = crowd(10'000);
    const auto queries = queries_about(500);
    std::vector<float> first;
    for (const std::size_t group : {1, 16, 64, 256}) {
        device_.set_work_group_size(group);
        PhotonCloud cloud(device_, unit_box, photons.size());
        cloud.build_dense(photons, 0.01f);
        std::vector<float> radii;
        for (const GatherQuery& query : find(cloud, 30, 0.01f, 0.3f, queries)) radii.push_back(query.radius);
        if (first.empty()) first = radii;
        EXPECT_EQ(radii, first) << "groups of " << group;
    }
}

} // namespace
} // namespace sundog
