// A million rays against Embree in its robust mode, on triangles that are thin, tiny or degenerate.
#include "render/bench_meshes.h"
#include "render/bench_ray_sets.h"
#include "trace_fixture.h"

#include <algorithm>

namespace sundog
{
namespace
{

constexpr double epsilon = 0x1p-24;

// Triangles of all sizes in [-1, 1]^3: ordinary ones, needles down to 1e-4 of their length, tiny ones, and some
// without area (a point, a line, two equal vertices).
TriangleMesh triangle_soup()
{
    TriangleMesh mesh;
    TestRandom random(3);
    const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
        const uint first = static_cast<uint>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, b, c});
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 4000; i++) {
        const Vec3 a = random.in_cube(1.0f);
        const float size = 0.3f * std::pow(1e-4f, random.uniform()), width = std::pow(1e-4f, random.uniform());
        const Vec3 along = size * random.direction();
        switch (i % 8) {
        case 0:
            add(a, a, a);
            break;
        case 1:
            add(a, a + along, a);
            break;
        case 2:
            add(a, a + along, a + 2.0f * along);
            break;
        case 3:
        case 4:
            add(a, a + along, a + size * width * random.direction());
            break;
        default:
            add(a, a + along, a + size * random.direction());
        }
    }
    add_icosphere(mesh, {0.2f, 0.1f, 0.0f}, 0.5f, 3);
    add_box(mesh, {-2, -2, -2}, {2, 2, 2});
    return mesh;
}

struct Corners {
    Point a, b, c;
    Corners(const TriangleMesh& mesh, uint triangle)
        : a(mesh.positions[mesh.triangles[triangle][0]]), b(mesh.positions[mesh.triangles[triangle][1]]),
          c(mesh.positions[mesh.triangles[triangle][2]])
    {
    }
};

// Between the ray's line and the segment a b.
double line_segment_distance(const Ray& ray, Point a, Point b)
{
    const Point d = (1.0 / length(Point(ray.direction))) * Point(ray.direction), e = b - a, w = a - Point(ray.origin);
    const Point e_across = e - dot(e, d) * d, w_across = w - dot(w, d) * d;
    const double squared = dot(e_across, e_across);
    const double s = squared > 0.0 ? std::clamp(-dot(w_across, e_across) / squared, 0.0, 1.0) : 0.0;
    return length(w_across + s * e_across);
}

// Both sides round the distance to an edge by a few epsilons of the distance from the ray's origin, which is at most
// 7 in these scenes: 16 epsilons allow for both, and for the direction.
bool passes_by_edge(const TriangleMesh& mesh, const Ray& ray, uint triangle)
{
    const Corners corners(mesh, triangle);
    const double distance = std::min({line_segment_distance(ray, corners.a, corners.b), line_segment_distance(ray, corners.b, corners.c),
                                      line_segment_distance(ray, corners.c, corners.a)});
    return distance <= 16.0 * epsilon * 7.0;
}

// How far rounding may move the hit: weights lose the ratio of a triangle's length to its width, and a grazing
// ray multiplies by the inverse cosine.
double position_tolerance(const TriangleMesh& mesh, const Ray& ray, uint triangle)
{
    const Corners corners(mesh, triangle);
    const Point normal = cross(corners.b - corners.a, corners.c - corners.a);
    const double longest = std::max({length(corners.b - corners.a), length(corners.c - corners.b), length(corners.a - corners.c)});
    const double cosine = std::abs(dot(normal, Point(ray.direction))) / (length(normal) * length(Point(ray.direction)));
    return 64.0 * epsilon * 7.0 * (longest * longest / length(normal)) / cosine;
}

std::vector<Ray> random_rays(std::size_t count, unsigned seed)
{
    TestRandom random(seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; i++) {
        const Vec3 origin = random.in_cube(1.5f);
        const Vec3 direction = i % 2 ? random.direction() : random.in_cube(1.0f) - origin; // unnormalised
        rays.push_back({origin, i % 4 < 2 ? infinite : random.uniform(), direction, 0});
    }
    return rays;
}

class TraceEmbree : public TraceTest
{
protected:
    TraceEmbree() : mesh_(triangle_soup()) { load(mesh_); }
    TriangleMesh mesh_;
};

TEST_F(TraceEmbree, MillionRaysAgree)
{
    const std::vector<Ray> rays = random_rays(1000000, 5);
    const std::vector<Hit> hits = closest(rays);
    std::vector<Hit> reference(rays.size());
    EmbreeTracer(mesh_, RTC_SCENE_FLAG_ROBUST).closest(rays, reference);
    std::size_t at_edges = 0, unexplained = 0, found = 0;
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Hit &ours = hits[i], &theirs = reference[i];
        if (ours.primitive == theirs.primitive) {
            if (ours.primitive == NO_PRIMITIVE) continue;
            found++;
            const double tolerance = position_tolerance(mesh_, rays[i], ours.primitive) / length(Point(rays[i].direction));
            EXPECT_NEAR(ours.t, theirs.t, tolerance) << "ray " << i;
            continue;
        }
        // The nearer of the two hits is the one that the other side did not see.
        const Hit& nearer = ours.t <= theirs.t ? ours : theirs;
        const bool is_edge = nearer.primitive != NO_PRIMITIVE && passes_by_edge(mesh_, rays[i], nearer.primitive);
        const bool is_end = std::abs(nearer.t - rays[i].t_max) <= 1e-5f * rays[i].t_max;
        (is_edge || is_end ? at_edges : unexplained)++;
    }
    EXPECT_EQ(unexplained, 0u);
    EXPECT_GT(found, rays.size() / 2);
    // A ray is near enough to an edge to be in doubt with probability (perimeter x width of the doubtful strip) /
    // (area of a view): about 6000 triangles of mean perimeter 0.3 and a strip of 2 x 7e-6 over an area of 4 make
    // 6e-3. Embree shears and rounds as we do, so that most of those agree: 1e-4 leaves room for other compilers.
    EXPECT_LT(at_edges, rays.size() / 10000);
    RecordProperty("disagreements_at_edges", static_cast<int>(at_edges));
}

TEST_F(TraceEmbree, WeightsGiveThePoint)
{
    const std::vector<Ray> rays = random_rays(200000, 6);
    const std::vector<Hit> hits = closest(rays);
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Hit& hit = hits[i];
        if (hit.primitive == NO_PRIMITIVE) continue;
        const Corners corners(mesh_, hit.primitive);
        const Point by_weights = corners.a + hit.u * (corners.b - corners.a) + hit.v * (corners.c - corners.a);
        const Point by_distance = Point(rays[i].origin) + hit.t * Point(rays[i].direction);
        EXPECT_LE(length(by_weights - by_distance), position_tolerance(mesh_, rays[i], hit.primitive)) << "ray " << i;
        EXPECT_GE(hit.u, 0.0f);
        EXPECT_GE(hit.v, 0.0f);
        EXPECT_LE(hit.u + hit.v, 1.0f + 4e-7f);
    }
}

TEST_F(TraceEmbree, AnyHitAgreesWithClosestHit)
{
    const std::vector<Ray> rays = random_rays(1000000, 7);
    const std::vector<Hit> hits = closest(rays);
    const std::vector<uint> blocked = any(rays);
    std::size_t differences = 0;
    for (std::size_t i = 0; i < rays.size(); i++) differences += (hits[i].primitive != NO_PRIMITIVE) != (blocked[i] == 1);
    EXPECT_EQ(differences, 0u);
}

TEST_F(TraceEmbree, RayEndsBeforeItsLength)
{
    std::vector<Ray> rays = random_rays(100000, 8);
    const std::vector<Hit> hits = closest(rays);
    std::vector<Ray> shorter = rays, longer = rays;
    for (std::size_t i = 0; i < rays.size(); i++) {
        shorter[i].t_max = hits[i].t;
        longer[i].t_max = std::nextafter(hits[i].t, infinite);
    }
    const std::vector<Hit> none = closest(shorter), same = closest(longer);
    for (std::size_t i = 0; i < rays.size(); i++) {
        if (hits[i].primitive == NO_PRIMITIVE) continue;
        EXPECT_EQ(none[i].primitive, NO_PRIMITIVE) << "ray " << i;
        EXPECT_EQ(none[i].t, shorter[i].t_max);
        EXPECT_EQ(same[i].primitive, hits[i].primitive) << "ray " << i;
        EXPECT_EQ(same[i].t, hits[i].t);
    }
}

} // namespace
} // namespace sundog
