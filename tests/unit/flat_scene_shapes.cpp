// Flattening: shapes, normals, scattering records, and the camera.
#include "math/vec3.h"
#include "scene/flat_scene.h"
#include "support/scene_builder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sundog
{
namespace
{

const PointEmitter lamp{{0, 0, 9}, {1, 1, 1}};

TEST(FlatSceneShapes, IndicesFollowTheShapes)
{
    SceneBuilder builder;
    const uint other = builder.bsdf(NullBsdf{});
    builder.shape(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}))
        .shape(Sphere{{1, 2, 3}, 0.5f, true}, other)
        .shape(triangle({5, 0, 0}, {6, 0, 0}, {5, 1, 0}), other)
        .shape(Disk{{0, 0, 1}, {2, 0, 0}, {0, 3, 0}})
        .emitter(lamp);
    const FlatScene flat = flatten_scene(builder.scene);
    ASSERT_EQ(flat.shapes.size(), 4u);
    ASSERT_EQ(flat.triangles.size(), 3u);
    ASSERT_EQ(flat.analytics.size(), 2u);
    EXPECT_EQ(flat.shapes[0].first_primitive, 0u);
    EXPECT_EQ(flat.shapes[1].first_primitive, 0u);
    EXPECT_EQ(flat.shapes[2].first_primitive, 2u);
    EXPECT_EQ(flat.shapes[3].first_primitive, 1u);
    EXPECT_EQ(flat.shapes[1].bsdf, other);
    EXPECT_EQ(flat.shapes[1].flags, SHAPE_FLIP_NORMALS);
    EXPECT_EQ(flat.triangles[2].shape, 2u);
    for (uint corner = 0; corner < 3; ++corner) EXPECT_EQ(flat.triangles[2].vertex[corner], 4 + corner);
    EXPECT_EQ(flat.positions[flat.triangles[2].vertex[1]].x, 6.0f);
    EXPECT_EQ(flat.analytics[0].kind, ANALYTIC_SPHERE);
    EXPECT_EQ(flat.analytics[0].shape, 1u);
    EXPECT_EQ(flat.analytics[1].kind, ANALYTIC_DISK);
    EXPECT_EQ(flat.analytics[1].normal.z, 1.0f);
    for (const Shape& shape : flat.shapes) EXPECT_EQ(shape.first_light, NO_LIGHT);
}

// Normals are found by the positions' indices, though only some meshes have them.
TEST(FlatSceneShapes, NormalsStayBesideTheirPositions)
{
    const auto with_normals = [](Vec3 normal, float offset) {
        TriangleMesh mesh = triangle({offset, 0, 0}, {offset + 1, 0, 0}, {offset, 1, 0});
        mesh.normals.assign(3, normal);
        return mesh;
    };
    const auto plain = [](float offset) { return parallelogram({offset, 0, 0}, {1, 0, 0}, {0, 1, 0}); };
    const FlatScene flat = flatten_scene(SceneBuilder()
                                             .shape(plain(0))
                                             .shape(with_normals({0, 0, 1}, 10))
                                             .shape(plain(20))
                                             .shape(with_normals({0, 1, 0}, 30))
                                             .shape(plain(40))
                                             .emitter(lamp)
                                             .scene);
    ASSERT_EQ(flat.normals.size(), flat.positions.size());
    for (std::size_t shape = 0; shape < 5; ++shape) EXPECT_EQ(flat.shapes[shape].flags, shape % 2 == 1 ? SHAPE_HAS_NORMALS : 0u) << shape;
    for (const Triangle& t : flat.triangles)
        for (const uint vertex : t.vertex) {
            if (t.shape == 1) {
                EXPECT_EQ(flat.normals[vertex].z, 1.0f);
            }
            if (t.shape == 3) {
                EXPECT_EQ(flat.normals[vertex].y, 1.0f);
            }
        }
    EXPECT_TRUE(flatten_scene(SceneBuilder().shape(plain(0)).emitter(lamp).scene).normals.empty());
}

TEST(FlatSceneShapes, CylindersDisksAndSpheresKeepTheirAxes)
{
    const Cylinder cylinder{.start = {1, 2, 3}, .radius = 0.5f, .length = 4, .flip_normals = true, .axis_x = {0, 1, 0}, .axis_y = {0, 0, 1}, .axis_z = {1, 0, 0}};
    Sphere sphere{{0, 0, 0}, 1.0f};
    sphere.axis_x = {0, 0, 1};
    sphere.axis_z = {-1, 0, 0};
    const FlatScene flat = flatten_scene(SceneBuilder()
                                             .light(cylinder, {1, 1, 1})
                                             .shape(Disk{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, true})
                                             .shape(sphere)
                                             .scene);
    const AnalyticPrimitive& tube = flat.analytics.at(0);
    EXPECT_EQ(tube.kind, ANALYTIC_CYLINDER);
    EXPECT_EQ(tube.center, (Vec3{1, 2, 3}));
    EXPECT_EQ(tube.length, 4.0f);
    EXPECT_EQ(tube.radius, 0.5f);
    EXPECT_EQ(tube.normal, (Vec3{1, 0, 0}));
    EXPECT_EQ(tube.axis_u, (Vec3{0, 1, 0}));
    EXPECT_EQ(flat.shapes[0].flags, SHAPE_FLIP_NORMALS);
    EXPECT_EQ(flat.lights.at(0).type, LIGHT_CYLINDER);
    EXPECT_NEAR(flat.lights[0].area, 2 * std::numbers::pi * 0.5 * 4, 1e-5);
    EXPECT_EQ(flat.analytics.at(1).axis_u, (Vec3{2, 0, 0})) << "where texture coordinates begin";
    EXPECT_EQ(flat.analytics[1].normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(flat.analytics.at(2).axis_u, (Vec3{0, 0, 1}));
    EXPECT_EQ(flat.analytics[2].normal, (Vec3{-1, 0, 0}));
}

TEST(FlatSceneShapes, CylinderBoundsAreTight)
{
    const Vec3 axis = normalize(Vec3{1, 2, 2});
    const Vec3 x = normalize(Vec3{2, -1, 0});
    Scene scene = SceneBuilder().shape(Cylinder{.start = {1, 1, 1}, .radius = 0.5f, .length = 3, .axis_x = x, .axis_y = cross(axis, x), .axis_z = axis}).scene;
    const Bounds bounds = scene.bounds();
    // A circle of radius r reaches r sqrt(1 - a^2) along an axis that is at cosine a to its normal.
    const float a[] = {1.0f / 3, 2.0f / 3, 2.0f / 3};
    for (int k = 0; k < 3; ++k) {
        const float reach = 0.5f * std::sqrt(1 - a[k] * a[k]);
        EXPECT_NEAR(component(bounds.lower, k), 1 - reach, 1e-6f);
        EXPECT_NEAR(component(bounds.upper, k), 1 + 3 * a[k] + reach, 1e-6f);
    }
}

TEST(FlatSceneShapes, BoundingSphereHoldsEverything)
{
    const FlatScene flat = flatten_scene(
        SceneBuilder().shape(Sphere{{2, 0, 0}, 1.0f, false}).shape(triangle({-1, 0, 0}, {0, 4, 0}, {0, 0, 2})).emitter(lamp).scene);
    for (const Vec3 corner : {Vec3{-1, -1, -1}, Vec3{3, 4, 2}}) EXPECT_LE(length(corner - flat.globals.center), flat.globals.radius);
    EXPECT_LT(flat.globals.radius, 1.01f * 0.5f * length(Vec3{4, 5, 3}));
}

TEST(FlatSceneBsdfs, RecordsKeepTheirModels)
{
    SceneBuilder builder;
    const uint red = builder.bsdf(DiffuseBsdf{{0.7f, 0.1f, 0.2f}});
    const uint glass = builder.bsdf(DielectricBsdf{1.5f, 1.2f, false, {1, 1, 1}, {0.5f, 0.5f, 0.5f}});
    const uint pane = builder.bsdf(DielectricBsdf{1.5f, 1.0f, true, {1, 1, 1}, {1, 1, 1}});
    const uint metal = builder.bsdf(ConductorBsdf{{0.1f, 0.2f, 0.3f}, {3, 2, 1}, {0.9f, 1, 1}});
    const uint both = builder.bsdf(TwoSidedBsdf{red, metal});
    builder.shape(Sphere{}).emitter(lamp);
    const std::vector<Bsdf> bsdfs = flatten_scene(builder.scene).bsdfs;
    EXPECT_EQ(bsdfs[red].type, BSDF_DIFFUSE);
    EXPECT_EQ(bsdfs[red].flags, BSDF_HAS_SMOOTH | BSDF_HAS_BROAD | BSDF_BLACK_BACK);
    EXPECT_EQ(bsdfs[glass].type, BSDF_DIELECTRIC);
    EXPECT_FLOAT_EQ(bsdfs[glass].eta, 1.25f);
    EXPECT_EQ(bsdfs[glass].transmittance.value.x, 0.5f);
    EXPECT_EQ(bsdfs[pane].type, BSDF_THIN_DIELECTRIC);
    EXPECT_EQ(bsdfs[metal].type, BSDF_CONDUCTOR);
    EXPECT_EQ(bsdfs[metal].k_rgb.y, 2.0f);
    EXPECT_EQ(bsdfs[metal].specular.value.x, 0.9f);
    EXPECT_EQ(bsdfs[both].type, BSDF_DIFFUSE) << "the front's record";
    EXPECT_EQ(bsdfs[both].reflectance.value.x, 0.7f);
    EXPECT_EQ(bsdfs[both].flags, BSDF_TWO_SIDED | BSDF_HAS_SMOOTH | BSDF_HAS_BROAD);
    EXPECT_EQ(bsdfs[both].back, metal);
}

// A two-sided BSDF may come before its sides.
TEST(FlatSceneBsdfs, TwoSidedMayNameLaterOnes)
{
    SceneBuilder builder;
    const uint both = builder.bsdf(TwoSidedBsdf{2, 3});
    builder.bsdf(DiffuseBsdf{{0.25f, 0, 0}});
    builder.bsdf(DiffuseBsdf{{0.75f, 0, 0}});
    builder.shape(Sphere{}).emitter(lamp);
    const std::vector<Bsdf> bsdfs = flatten_scene(builder.scene).bsdfs;
    EXPECT_EQ(bsdfs[both].reflectance.value.x, 0.25f);
    EXPECT_EQ(bsdfs[bsdfs[both].back].reflectance.value.x, 0.75f);
}

TEST(FlatSceneCamera, OrthographicExtentsAndPrincipalPoint)
{
    Sensor sensor;
    sensor.projection = Projection::orthographic;
    sensor.extent_x = 4.0f;
    sensor.extent_y = 3.0f;
    sensor.principal_offset_x = 0.25f;
    sensor.principal_offset_y = -0.5f;
    Film film;
    film.width = 200;
    film.height = 50;
    const Camera camera = make_camera(sensor, film);
    EXPECT_EQ(camera.kind, CAMERA_ORTHOGRAPHIC);
    EXPECT_EQ(camera.half_width, 4.0f);
    EXPECT_EQ(camera.half_height, 0.75f); // of square pixels, a quarter as high as wide, were extents the same
    EXPECT_EQ(camera.shift_x, -2.0f); // a quarter of the width of 8
    EXPECT_EQ(camera.shift_y, 0.75f); // half the height of 1.5
    EXPECT_EQ(make_camera(Sensor(), film).kind, CAMERA_PERSPECTIVE);
}

TEST(FlatSceneCamera, TangentsReferToTheFullFilm)
{
    Sensor sensor;
    sensor.fov_x = 0.5f * std::numbers::pi_v<float>;
    sensor.aperture_radius = 0.25f;
    sensor.focus_distance = 3.0f;
    sensor.near_clip = 0.5f;
    sensor.far_clip = 50.0f;
    sensor.position = {1, 2, 3};
    Film film;
    film.width = 400;
    film.height = 100;
    film.crop_x = 10;
    film.crop_y = 20;
    film.crop_width = 30;
    film.crop_height = 40;
    const Camera camera = make_camera(sensor, film);
    EXPECT_NEAR(camera.half_width, 1.0f, 1e-6f);
    EXPECT_NEAR(camera.half_height, 0.25f, 1e-6f);
    EXPECT_EQ(camera.aperture_radius, 0.25f);
    EXPECT_EQ(camera.focus_distance, 3.0f);
    EXPECT_EQ(camera.near_clip, 0.5f);
    EXPECT_EQ(camera.far_clip, 50.0f);
    EXPECT_EQ(camera.position.z, 3.0f);
    EXPECT_EQ(camera.film_width, 400);
    EXPECT_EQ(camera.crop_x, 10);
    EXPECT_EQ(camera.crop_y, 20);
    EXPECT_EQ(camera.crop_width, 30);
    EXPECT_EQ(camera.crop_height, 40);
}

} // namespace
} // namespace sundog
