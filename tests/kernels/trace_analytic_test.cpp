// Spheres, disks and cylinders, alone and among triangles, against double precision.
#include "render/bench_meshes.h"
#include "trace_fixture.h"

#include <algorithm>

namespace sundog
{
namespace
{

AnalyticPrimitive make_sphere(Vec3 center, float radius)
{
    AnalyticPrimitive sphere{};
    sphere.center = center;
    sphere.radius = radius;
    sphere.kind = ANALYTIC_SPHERE;
    return sphere;
}

AnalyticPrimitive make_disk(Vec3 center, Vec3 axis_u, Vec3 axis_v)
{
    AnalyticPrimitive disk{};
    disk.center = center;
    disk.axis_u = axis_u;
    disk.axis_v = axis_v;
    disk.normal = normalize(cross(axis_u, axis_v));
    disk.kind = ANALYTIC_DISK;
    return disk;
}

AnalyticPrimitive make_cylinder(Vec3 start, Vec3 axis, float length, float radius)
{
    AnalyticPrimitive cylinder{};
    cylinder.center = start;
    cylinder.radius = radius;
    cylinder.length = length;
    cylinder.normal = normalize(axis);
    cylinder.axis_u = normalize(cross(cylinder.normal, std::abs(cylinder.normal.x) > 0.5f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
    cylinder.axis_v = cross(cylinder.normal, cylinder.axis_u);
    cylinder.kind = ANALYTIC_CYLINDER;
    return cylinder;
}

// What a double-precision test finds. margin: how close the ray passes to the primitive's silhouette, relative to its
// size. cosine: of the angle between ray and normal, by which the rounding of a disk's normal is divided.
struct Reference {
    double t = infinite;
    double margin = infinite;
    double cosine = 1.0;
};

// Both crossings of the endless cylinder, then whether they lie between the ends.
Reference intersect_cylinder(const AnalyticPrimitive& cylinder, Point o, Point d)
{
    const Point axis(cylinder.normal);
    const double r = cylinder.radius, end = cylinder.length;
    const Point across_o = o - dot(o, axis) * axis, across_d = d - dot(d, axis) * axis;
    const double a = dot(across_d, across_d), b = dot(across_o, across_d), c = dot(across_o, across_o) - r * r;
    const double discriminant = b * b - a * c;
    Reference found{infinite, std::abs(discriminant) / (a * r * r)};
    if (discriminant < 0.0) return found;
    for (const double t : {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a}) {
        const double height = dot(o + t * d, axis);
        if (t > 0.0) found.margin = std::min(found.margin, std::min(std::abs(height), std::abs(height - end)) / r);
        if (t > 0.0 && height >= 0.0 && height <= end) found.t = std::min(found.t, t);
    }
    // Along the axis t goes as the distance across over the sine of the angle to the axis.
    found.cosine = std::sqrt(a) / length(d);
    return found;
}

Reference intersect(const AnalyticPrimitive& primitive, const Ray& ray)
{
    const Point o = Point(ray.origin) - Point(primitive.center), d(ray.direction);
    if (primitive.kind == ANALYTIC_CYLINDER) return intersect_cylinder(primitive, o, d);
    if (primitive.kind == ANALYTIC_SPHERE) {
        const double a = dot(d, d), b = dot(o, d) / a, r = primitive.radius;
        const Point closest = o - b * d;
        const double discriminant = r * r - dot(closest, closest);
        const double margin = std::abs(discriminant) / (r * r);
        if (discriminant < 0.0) return {infinite, margin};
        const double half = std::sqrt(discriminant / a);
        return {-b - half > 0.0 ? -b - half : -b + half > 0.0 ? -b + half : infinite, margin};
    }
    const Point u(primitive.axis_u), v(primitive.axis_v), n = cross(u, v);
    const double t = -dot(n, o) / dot(n, d);
    const Point p = o + t * d;
    // Weights by Cramer's rule on areas.
    const double a = dot(cross(p, v), n) / dot(n, n), b = dot(cross(u, p), n) / dot(n, n);
    const double radius = a * a + b * b;
    return {t > 0.0 && radius <= 1.0 ? t : infinite, std::abs(radius - 1.0), std::abs(dot(n, d)) / (length(n) * length(d))};
}

std::vector<AnalyticPrimitive> random_primitives(int count)
{
    TestRandom random(21);
    std::vector<AnalyticPrimitive> primitives;
    for (int i = 0; i < count; i++) {
        const Vec3 center = random.in_cube(1.0f);
        const float size = 0.3f * std::pow(1e-3f, random.uniform());
        if (i % 4 == 3)
            primitives.push_back(make_cylinder(center, random.direction(), size * random.between(0.5f, 3.0f), size));
        else if (i % 2)
            primitives.push_back(make_sphere(center, size));
        else
            primitives.push_back(make_disk(center, size * random.direction(), size * random.direction())); // sheared ellipses
    }
    return primitives;
}

class TraceAnalytic : public TraceTest
{
};

TEST_F(TraceAnalytic, AgreesWithDoublePrecision)
{
    const std::vector<AnalyticPrimitive> primitives = random_primitives(100);
    load({}, primitives);
    TestRandom random(22);
    std::vector<Ray> rays;
    for (int i = 0; i < 200000; i++) {
        const Vec3 origin = random.in_cube(1.5f);
        const Vec3 target = primitives[random.index(primitives.size())].center;
        rays.push_back({origin, infinite, i % 2 ? random.direction() : target - origin, 0});
    }
    const std::vector<Hit> hits = closest(rays);
    const std::vector<uint> blocked = any(rays);
    std::size_t doubtful = 0, found = 0;
    for (std::size_t i = 0; i < rays.size(); i++) {
        double t = infinite;
        uint nearest = NO_PRIMITIVE;
        double margin = infinite, cosine = 1.0;
        for (std::size_t k = 0; k < primitives.size(); k++) {
            const Reference reference = intersect(primitives[k], rays[i]);
            margin = std::min(margin, reference.margin);
            if (reference.t < t) t = reference.t, cosine = reference.cosine, nearest = static_cast<uint>(k) | ANALYTIC_BIT;
        }
        ASSERT_EQ(blocked[i] == 1, hits[i].primitive != NO_PRIMITIVE);
        // Sizes go down to 3e-4 at distances up to 5: positions are off by 16 epsilons of 5, which is 2e-2 of
        // that size, or where a disk is nearly edge-on, more.
        if (margin < 0.05 || (t < 1e-5 && hits[i].t < 1e-5f)) {
            doubtful++;
            continue;
        }
        found += nearest != NO_PRIMITIVE;
        if (nearest != hits[i].primitive) {
            // Two surfaces at the same distance, within rounding.
            ASSERT_NE(hits[i].primitive, NO_PRIMITIVE) << "ray " << i;
            EXPECT_NEAR(intersect(primitives[hits[i].primitive & ~ANALYTIC_BIT], rays[i]).t, t, 1e-4 * t) << "ray " << i;
        } else if (nearest != NO_PRIMITIVE) {
            EXPECT_NEAR(hits[i].t, t, (1e-5 / cosine + 1e-4) * t + 1e-6) << "ray " << i;
        }
    }
    EXPECT_GT(found, rays.size() / 4);
    EXPECT_LT(doubtful, rays.size() / 5);
}

// A small sphere far away: the textbook discriminant loses all digits here (b^2 and 4ac agree to 8 places).
TEST_F(TraceAnalytic, SmallSphereFarAway)
{
    const float distance = 1e4f, radius = 0.5f;
    load({}, {make_sphere({0, 0, 0}, radius)});
    TestRandom random(23);
    std::vector<Ray> rays;
    std::vector<bool> inside;
    for (int i = 0; i < 20000; i++) {
        const float angle = random.between(0.0f, 6.2831853f), r = random.between(0.0f, 1.0f);
        if (std::abs(r - radius) < 0.01f) continue; // coordinates are spaced 1e-3 apart at that distance
        rays.push_back({{r * std::cos(angle), r * std::sin(angle), -distance}, infinite, {0, 0, 1}, 0});
        inside.push_back(r < radius);
    }
    const std::vector<Hit> hits = closest(rays);
    for (std::size_t i = 0; i < rays.size(); i++) {
        ASSERT_EQ(hits[i].primitive == ANALYTIC_BIT, inside[i]);
        if (!inside[i]) continue;
        const Point o(rays[i].origin);
        EXPECT_NEAR(hits[i].t, distance - std::sqrt(radius * radius - o.x * o.x - o.y * o.y), 2e-3);
    }
}

// From inside, from the surface outwards (lifted by a few ulps) and inwards.
TEST_F(TraceAnalytic, FromInsideAndFromTheSurface)
{
    for (float radius : {1e-3f, 1.0f, 1e4f}) {
        load({}, {make_sphere({0, 0, 0}, radius)});
        TestRandom random(24);
        std::vector<Ray> rays;
        for (int i = 0; i < 30000; i++) {
            const Vec3 normal = random.direction(), other = random.direction();
            const Vec3 outwards = dot(normal, other) > 0.0f ? other : -other;
            if (i % 3 == 0) rays.push_back({radius * random.in_cube(0.5f), infinite, random.direction(), 0});
            if (i % 3 == 1) rays.push_back({radius * 1.000002f * normal, infinite, outwards, 0});
            if (i % 3 == 2) rays.push_back({radius * 0.999998f * normal, infinite, -outwards, 0});
        }
        const std::vector<Hit> hits = closest(rays);
        for (std::size_t i = 0; i < rays.size(); i++) {
            if (i % 3 == 1) {
                EXPECT_EQ(hits[i].primitive, NO_PRIMITIVE);
                continue;
            }
            ASSERT_EQ(hits[i].primitive, ANALYTIC_BIT);
            EXPECT_NEAR(length(Point(rays[i].origin) + hits[i].t * Point(rays[i].direction)), radius, 1e-6 * radius);
            EXPECT_GT(hits[i].t, 0.0f);
        }
    }
}

// Open at both ends, hit from outside, from inside and through the ends.
TEST_F(TraceAnalytic, CylindersAreOpen)
{
    load({}, {make_cylinder({1, 2, 0}, {0, 0, 1}, 2.0f, 0.5f)});
    const std::vector<Hit> hits = closest({{{3, 2, 1}, infinite, {-1, 0, 0}, 0},        // from outside
                                           {{1, 2, 1}, infinite, {0, 1, 0}, 0},         // from the axis
                                           {{1, 2, 5}, infinite, {0, 0, -1}, 0},        // along the axis
                                           {{1.2f, 2, 3}, infinite, {0, 0, -2}, 0},     // beside it
                                           {{3, 2, 2.01f}, infinite, {-1, 0, 0}, 0},    // above the end
                                           {{3, 2, -0.01f}, infinite, {-1, 0, 0}, 0},   // below the start
                                           {{1, 1, 2.6f}, infinite, {0, 1, -1}, 0},     // in through the end, to the far side
                                           {{1, 2, 1.5f}, infinite, {0, 0.2f, 1}, 0}}); // out through the end
    const float expected[] = {1.5f, 0.5f, 0, 0, 0, 0, 1.5f, 0};
    for (std::size_t i = 0; i < hits.size(); i++) {
        SCOPED_TRACE(i);
        EXPECT_EQ(hits[i].primitive, expected[i] > 0 ? ANALYTIC_BIT : NO_PRIMITIVE);
        if (expected[i] > 0) {
            EXPECT_NEAR(hits[i].t, expected[i], 1e-6f);
        }
    }
}

TEST_F(TraceAnalytic, AmongTriangles)
{
    TriangleMesh mesh;
    add_box(mesh, {-2, -2, -2}, {2, 2, 2});
    load(mesh, {make_sphere({0, 0, 0}, 1.0f), make_disk({1.5f, 0, 0}, {0, 0.5f, 0}, {0, 0, 0.5f})});
    const std::vector<Hit> hits = closest({{{-1.9f, 0, 0}, infinite, {1, 0, 0}, 0},
                                           {{1.9f, 0, 0}, infinite, {-1, 0, 0}, 0},
                                           {{1.9f, 0.6f, 0}, infinite, {-1, 0, 0}, 0},
                                           {{0, 0, 1.5f}, infinite, {0, 0, 1}, 0}});
    EXPECT_EQ(hits[0].primitive, ANALYTIC_BIT);
    EXPECT_NEAR(hits[0].t, 0.9f, 1e-6f);
    EXPECT_EQ(hits[1].primitive, ANALYTIC_BIT | 1u);
    EXPECT_NEAR(hits[1].t, 0.4f, 1e-6f);
    EXPECT_EQ(hits[2].primitive, ANALYTIC_BIT);
    EXPECT_NEAR(hits[2].t, 1.1f, 1e-6f);
    EXPECT_LT(hits[3].primitive, 12u);
    EXPECT_NEAR(hits[3].t, 0.5f, 1e-6f);
}

} // namespace
} // namespace sundog
