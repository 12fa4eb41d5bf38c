// Rays through instances against Embree on copies of the same geometry.
#include "render/bench_meshes.h"
#include "render/bench_ray_sets.h"
#include "scene/scene_bvh.h"
#include "support/instanced_scene.h"
#include "support/scene_builder.h"
#include "trace_fixture.h"

namespace sundog
{
namespace
{

TriangleMesh triangle_soup()
{
    TriangleMesh mesh;
    TestRandom random(41);
    for (uint i = 0; i < 300; i++) {
        const Vec3 a = random.in_cube(0.9f);
        mesh.positions.insert(mesh.positions.end(), {a, a + 0.3f * random.direction(), a + 0.3f * random.direction()});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

TriangleMesh sphere_mesh(int subdivisions)
{
    TriangleMesh mesh;
    add_icosphere(mesh, {0, 0, 0}, 1.0f, subdivisions);
    return mesh;
}

class TraceInstances : public TraceTest
{
protected:
    void load(const Scene& scene)
    {
        const FlatScene flat = flatten_scene(scene);
        geometry_ = upload_geometry(device_, build_scene_bvh(flat), flat.analytics, flat.globals);
        const BuildOptions options = trace_options(flat.analytics, flat.instances);
        trace_closest_ = Kernel(device_, "trace_closest", "Trace closest hits", options);
        trace_any_ = Kernel(device_, "trace_any", "Trace shadow rays", options);
    }
};

const PointEmitter lamp{{0, 0, 9}, {1, 1, 1}};

// A room (of the world) with copies of a group of two meshes in it.
struct Room {
    Scene scene;
    TriangleMesh copies;                              // of everything
    std::vector<std::pair<uint, uint>> origins;       // of each of its triangles: instance and primitive

    void copy(const TriangleMesh& mesh, uint instance, uint first_primitive)
    {
        const uint base = static_cast<uint>(copies.positions.size());
        copies.positions.insert(copies.positions.end(), mesh.positions.begin(), mesh.positions.end());
        for (uint i = 0; i < mesh.triangles.size(); i++) {
            const auto& [a, b, c] = mesh.triangles[i];
            copies.triangles.push_back({base + a, base + b, base + c});
            origins.emplace_back(instance, first_primitive + i);
        }
    }

    Room()
    {
        TriangleMesh walls;
        add_box(walls, {-4, -4, -4}, {4, 4, 4});
        const TriangleMesh soup = triangle_soup(), ball = sphere_mesh(3);
        SceneBuilder builder;
        // The group's shapes stand first: the world's primitives are numbered first all the same.
        builder.shape(soup).shape(ball).emitter(lamp);
        make_instances(builder.scene, 0, assorted_placements());
        builder.shape(walls);
        scene = builder.scene;
        const uint world_triangles = static_cast<uint>(walls.triangles.size());
        copy(walls, NO_INSTANCE, 0);
        for (uint i = 0; i < scene.instances.size(); i++) {
            copy(transformed(soup, scene.instances[i].to_world.at(0)), i, world_triangles);
            copy(transformed(ball, scene.instances[i].to_world.at(0)), i, world_triangles + static_cast<uint>(soup.triangles.size()));
        }
    }
};

TEST_F(TraceInstances, RaysAgreeWithEmbreeOnCopies)
{
    const Room room;
    load(room.scene);
    TestRandom random(42);
    std::vector<Ray> rays;
    for (int i = 0; i < 400000; i++) {
        const Vec3 origin = random.in_cube(4.0f);
        const Vec3 place = room.scene.instances[random.index(room.scene.instances.size())].to_world.at(0).point(random.in_cube(0.7f));
        rays.push_back({origin, i % 4 ? infinite : random.between(0.0f, 3.0f), i % 2 ? place - origin : random.direction(), 0});
    }
    const std::vector<Hit> hits = closest(rays);
    const std::vector<uint> blocked = any(rays);
    std::vector<Hit> reference(rays.size());
    EmbreeTracer(room.copies, RTC_SCENE_FLAG_ROBUST).closest(rays, reference);

    std::vector<std::size_t> found(room.scene.instances.size() + 1);
    std::size_t different = 0, far_off = 0;
    for (std::size_t i = 0; i < rays.size(); i++) {
        EXPECT_EQ(blocked[i] == 1, hits[i].primitive != NO_PRIMITIVE) << "ray " << i;
        const bool theirs = reference[i].primitive != NO_PRIMITIVE;
        const auto expected = theirs ? room.origins[reference[i].primitive] : std::pair(NO_INSTANCE, NO_PRIMITIVE);
        if (std::pair(hits[i].primitive == NO_PRIMITIVE ? NO_INSTANCE : hits[i].instance, hits[i].primitive) != expected) {
            different++;
            continue;
        }
        if (!theirs) continue;
        found[std::min<std::size_t>(expected.first, room.scene.instances.size())]++;
        // Both sides round coordinates of up to 7 by some 16 epsilons; a grazing ray multiplies that by 1 / cosine.
        const auto& [a, b, c] = room.copies.triangles[reference[i].primitive];
        const Point p(room.copies.positions[a]), normal = cross(Point(room.copies.positions[b]) - p, Point(room.copies.positions[c]) - p);
        const Point d(rays[i].direction);
        const double cosine = std::abs(dot(normal, d)) / (length(normal) * length(d));
        far_off += std::abs(hits[i].t - reference[i].t) * length(d) * cosine > 16 * 7 * 0x1p-23;
    }
    // Rounding displaces a ray by less than d = 16 * 7 * 2^-24 = 7e-6, so that it may pass an edge on the other side. A ball
    // of 1280 triangles of perimeter 0.25 shows edges of length 80 on an area of pi, the soup as many: 2 d * 160 / pi =
    // 7e-4 of the rays at a copy of radius 1, and of those at the one of 1e-2, 7e-2. In the one of 1e-3 triangles are no
    // larger than ten times d: any of its rays may differ. Each is aimed at by a fourteenth of the rays, but by hits of other
    // copies and by rounding of a tenth of the bound, as is usual, less: (1 + 0.07) / 14 / 10 = 8e-3.
    EXPECT_LT(static_cast<double>(different), 8e-3 * static_cast<double>(rays.size()));
    EXPECT_EQ(far_off, 0u);
    for (std::size_t instance = 0; instance < found.size(); instance++) EXPECT_GT(found[instance], 1000u) << "of instance " << instance;
    RecordProperty("different", static_cast<int>(different));
}

// Without any geometry of the world's own, one instance, and analytic shapes that no transform of their own could make.
TEST_F(TraceInstances, OneStretchedSphereAlone)
{
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, 0}, 1.0f, false}).emitter(lamp);
    make_instances(builder.scene, 0, {Transform::translate({5, 0, 0}) * Transform::scale({1, 2, -3})});
    load(builder.scene);
    const std::vector<Ray> rays{{{0, 0, 0}, infinite, {1, 0, 0}, 0},      {{5, 10, 0}, infinite, {0, -2, 0}, 0},
                                {{5, 0, 10}, infinite, {0, 0, -1}, 0},    {{5, 0, 0}, infinite, {0, 0, 1}, 0},
                                {{0, 2.01f, 0}, infinite, {1, 0, 0}, 0},  {{0, 0, 2.99f}, infinite, {1, 0, 0}, 0},
                                {{5, 0, 10}, 6.99f, {0, 0, -1}, 0},       {{5, 0, 10}, 7.01f, {0, 0, -1}, 0}};
    const float inner = static_cast<float>(5 - std::sqrt(1 - 2.99 * 2.99 / 9));
    const float expected[] = {4, 4, 7, 3, infinite, inner, 6.99f, 7};
    const std::vector<Hit> hits = closest(rays);
    const std::vector<uint> blocked = any(rays);
    for (std::size_t i = 0; i < rays.size(); i++) {
        SCOPED_TRACE(i);
        const bool hit = expected[i] < rays[i].t_max;
        EXPECT_EQ(hits[i].primitive, hit ? ANALYTIC_BIT : NO_PRIMITIVE);
        if (hit) {
            EXPECT_EQ(hits[i].instance, 0u);
            EXPECT_NEAR(hits[i].t, expected[i], 1e-5f * expected[i]);
        }
        EXPECT_EQ(blocked[i], hit ? 1u : 0u);
    }
}

// An instance that hides a nearer triangle of the world, and the other way round.
TEST_F(TraceInstances, TheNearestOfBothLevels)
{
    SceneBuilder builder;
    builder.shape(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})).emitter(lamp);
    make_instances(builder.scene, 0, {Transform::translate({0, 0, 1}), Transform::translate({0, 0, 3})});
    builder.shape(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})).shape(parallelogram({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}));
    load(builder.scene);
    std::vector<Ray> rays;
    for (float z : {-0.5f, 0.5f, 1.5f, 2.5f, 3.5f}) rays.push_back({{0.3f, 0.2f, z}, infinite, {0, 0, 1}, 0});
    const std::vector<Hit> hits = closest(rays);
    const uint instances[] = {NO_INSTANCE, 0, NO_INSTANCE, 1, NO_INSTANCE};
    for (std::size_t i = 0; i < 5; i++) {
        EXPECT_EQ(hits[i].instance, instances[i]) << i;
        EXPECT_EQ(hits[i].primitive != NO_PRIMITIVE, i < 4) << i;
        if (i < 4) {
            EXPECT_NEAR(hits[i].t, 0.5f, 1e-6f) << i;
        }
    }
}

// A mesh stays closed under every transform: one rounded ray meets all of its triangles.
TEST_F(TraceInstances, NoRayGetsOut)
{
    TriangleMesh mesh = sphere_mesh(5);
    for (Vec3& p : mesh.positions) p = p * (0.7f + 0.3f * value_noise(40.0f * p.x + 9.0f * p.z, 40.0f * p.y - 7.0f * p.z));
    std::vector<Transform> placements = assorted_placements();
    placements.push_back(Transform::translate({1000, -2000, 500}) * placements[3]);
    placements.push_back(Transform::translate({3e5, 1e5, -2e5}) * Transform::scale({1e4, 3e4, 1e4}) * placements[3]);
    for (const Transform& to_world : placements) {
        SceneBuilder builder;
        builder.shape(mesh).emitter(lamp);
        make_instances(builder.scene, 0, {to_world});
        load(builder.scene);
        TestRandom random(43);
        std::vector<Ray> rays;
        for (int i = 0; i < (1 << 18); i++) {
            const auto& triangle = mesh.triangles[random.index(mesh.triangles.size())];
            const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]], origin = random.in_cube(0.35f);
            const Vec3 direction = i % 3 == 2 ? random.direction() : a + (i % 3 == 0 ? 0.0f : random.uniform()) * (b - a) - origin;
            rays.push_back({to_world.point(origin), infinite, to_world.vector(direction), 0});
        }
        std::size_t escaped = 0, unblocked = 0;
        for (const Hit& hit : closest(rays)) escaped += hit.primitive == NO_PRIMITIVE;
        for (uint blocked : any(rays)) unblocked += blocked == 0;
        EXPECT_EQ(escaped, 0u);
        EXPECT_EQ(unblocked, 0u);
    }
}

} // namespace
} // namespace sundog
