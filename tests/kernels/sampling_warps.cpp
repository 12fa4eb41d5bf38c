// Warps from uniform numbers to points and directions: each against its density.
#include "support/chi_squared.h"
#include "support/device_fixture.h"
#include "support/direction_grid.h"

namespace sundog
{
namespace
{

using std::numbers::pi;

constexpr int tests_in_file = 7;
constexpr uint samples = 200'000;

class Warps : public DeviceFixture
{
protected:
    enum Warp : uint { disk, cosine_hemisphere, cone, triangle };

    // cap: of the cone, 1 - cos of its half angle.
    std::vector<Vec3> draw(Warp warp, float cap = 2.0f)
    {
        const Kernel kernel = test_kernel(R"(
            #include "math/warp.h"
            __kernel void test(uint count, uint warp, float cap, __global Vec3* output)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const float2 u = random4(i, warp).xy;
                switch (warp) {
                case 0u: output[i] = pack((float3)(sample_disk(u), 0.0f)); break;
                case 1u: output[i] = pack(sample_cosine_hemisphere(u)); break;
                case 2u: output[i] = pack(cap < 2.0f ? sample_cone(u, cap) : sample_sphere(u)); break;
                default: output[i] = pack((float3)(sample_triangle(u), 0.0f)); break;
                }
            })");
        const auto output = allocate<Vec3>(samples);
        kernel(samples, samples, static_cast<uint>(warp), cap, output);
        return output.download();
    }
};

// Rings and sectors of equal area.
TEST_F(Warps, DiskIsUniform)
{
    std::vector<double> counts(16 * 32, 0.0);
    for (const Vec3 p : draw(disk)) {
        const double r2 = double(p.x) * p.x + double(p.y) * p.y;
        ASSERT_LE(r2, 1.0 + 1e-6);
        const int ring = std::min(15, static_cast<int>(r2 * 16)),
                  sector = std::min(31, static_cast<int>((std::atan2(p.y, p.x) / (2 * pi) + 0.5) * 32));
        counts.at(static_cast<std::size_t>(ring * 32 + sector)) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
}

TEST_F(Warps, CosineHemisphereFollowsItsDensity)
{
    const DirectionGrid grid{.rows = 20, .columns = 24};
    const auto expected = grid.expected([](Vec3d d) { return std::max(0.0, d.z) / pi; }, samples);
    EXPECT_TRUE(follows(grid.count(draw(cosine_hemisphere)), expected, tests_in_file));
}

TEST_F(Warps, ConesAndTheSphereAreUniform)
{
    for (const double cap : {1e-9, 1e-3, 0.7, 2.0}) { // the last is the sphere
        const DirectionGrid grid{.rows = 16, .columns = 24, .cap = cap};
        const auto directions = draw(cone, static_cast<float>(cap));
        const auto expected = grid.expected([cap](Vec3d) { return 1.0 / (2.0 * pi * cap); }, samples, 1);
        EXPECT_TRUE(follows(grid.count(directions), expected, tests_in_file)) << "1 - cos = " << cap;
        for (const Vec3 d : directions) ASSERT_NEAR(length(Vec3d(d)), 1.0, 1e-6);
    }
}

// Small congruent triangles: side / n, upright and inverted.
TEST_F(Warps, TriangleIsUniform)
{
    constexpr int n = 20;
    std::vector<double> counts(n * n, 0.0);
    for (const Vec3 p : draw(triangle)) {
        ASSERT_GE(p.x, 0.0f);
        ASSERT_GE(p.y, 0.0f);
        ASSERT_LE(p.x + p.y, 1.0f + 1e-6f);
        const double x = double(p.x) * n, y = double(p.y) * n;
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const bool inverted = x - i + y - j > 1.0;
        // Row j has 2 (n - j) - 1 triangles; the rows before it n^2 - (n - j)^2.
        const int index = n * n - (n - j) * (n - j) + 2 * i + (inverted ? 1 : 0);
        counts.at(static_cast<std::size_t>(std::min(index, n * n - 1))) += 1.0;
    }
    EXPECT_TRUE(is_uniform(counts, tests_in_file));
}

// Directions survive their packing: the error that the headers state.
TEST_F(Warps, PackedDirectionsKeepTheirDirection)
{
    const Kernel kernel = test_kernel(R"(
        #include "math/frame.h"
        #include "math/warp.h"
        __kernel void test(uint count, __global Vec3* directions, __global uint* packed, __global uint* normals)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            const float3 v = i < 6u ? (float3)(i == 0u ? 1.0f : i == 1u ? -1.0f : 0.0f, i == 2u ? 1.0f : i == 3u ? -1.0f : 0.0f, i == 4u ? 1.0f : i == 5u ? -1.0f : 0.0f)
                                    : sample_sphere(random4(i, 6u).xy);
            directions[i] = pack(v);
            packed[i] = pack_direction(v);
            normals[i] = pack_normal(v);
        })");
    const auto directions = allocate<Vec3>(samples);
    const auto packed = allocate<uint>(samples), normals = allocate<uint>(samples);
    kernel(samples, samples, directions, packed, normals);
    const auto unfold = [](double x, double y) {
        const double z = 1.0 - std::abs(x) - std::abs(y);
        const double fold = std::max(0.0, -z);
        return normalized(Vec3d(x - std::copysign(fold, x), y - std::copysign(fold, y), z));
    };
    const auto angle = [](Vec3d a, Vec3d b) { return 2.0 * std::asin(std::min(1.0, 0.5 * length(normalized(a) - normalized(b)))); };
    const auto v = directions.download();
    const auto p = packed.download(), n = normals.download();
    double worst_direction = 0.0, worst_normal = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        worst_direction =
            std::max(worst_direction, angle(v[i], unfold(((p[i] & 0xffff) + 0.5) / 32768.0 - 1.0, ((p[i] >> 16) + 0.5) / 32768.0 - 1.0)));
        // As gather_photons reads it.
        worst_normal = std::max(worst_normal,
                                angle(v[i], unfold(((n[i] & 0xfff) + 0.5) / 2048.0 - 1.0, (((n[i] >> 12) & 0xfff) + 0.5) / 2048.0 - 1.0)));
        ASSERT_LT(n[i], 1u << 24);
    }
    EXPECT_LT(worst_direction, 1e-4);
    EXPECT_LT(worst_normal, 1.2e-3);
}

TEST_F(Warps, FramesAreOrthonormalAndRightHanded)
{
    const Kernel kernel = test_kernel(R"(
        #include "math/frame.h"
        #include "math/warp.h"
        __kernel void test(uint count, __global Vec3* axes)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            float3 n = sample_sphere(random4(i, 7u).xy);
            if (i == 0u) n = (float3)(0.0f, 0.0f, -1.0f);
            if (i == 1u) n = (float3)(1e-4f, 0.0f, -1.0f);
            if (i == 2u) n = (float3)(1.0f, 0.0f, -0.0f);
            const Frame frame = make_frame(n);
            axes[3u * i] = pack(frame.s);
            axes[3u * i + 1u] = pack(frame.t);
            axes[3u * i + 2u] = pack(frame.n);
        })");
    const uint count = 10'000;
    const auto output = allocate<Vec3>(3 * count);
    kernel(count, count, output);
    const auto axes = output.download();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d s = axes[3 * i], t = axes[3 * i + 1], n = axes[3 * i + 2];
        ASSERT_NEAR(dot(s, t), 0.0, 1e-5) << i;
        ASSERT_NEAR(dot(s, n), 0.0, 1e-5) << i;
        ASSERT_NEAR(length(s), 1.0, 1e-5) << i;
        ASSERT_NEAR(length(cross(s, t) - n), 0.0, 1e-5) << i;
    }
}

} // namespace
} // namespace sundog
