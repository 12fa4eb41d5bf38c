// Photons of distant lights on a large ground: the share of them that an image uses, against what the camera's view says.
#include "import/mitsuba_xml.h"
#include "scene/photon_spread.h"
#include "support/places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace sundog
{
namespace
{

using testing::HasSubstr;
using std::numbers::pi;

// A camera of field of view 90 degrees at height 1 looks straight down at a square ground.
Scene ground(float half_width)
{
    Scene scene;
    scene.bsdfs.push_back({"", {}, DiffuseBsdf{{.5f, .5f, .5f}}});
    TriangleMesh mesh;
    mesh.positions = {{-half_width, 0, half_width}, {half_width, 0, half_width}, {half_width, 0, -half_width}, {-half_width, 0, -half_width}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    ShapeDescription shape;
    shape.geometry = mesh;
    shape.where = {"ground.xml", 7};
    scene.shapes.push_back(shape);
    scene.emitters.push_back({{}, DirectionalEmitter{{0, -1, 0}, {1, 1, 1}}});
    scene.sensor.position = {0, 1, 0};
    scene.sensor.axis_x = {1, 0, 0};
    scene.sensor.axis_y = {0, 0, 1};
    scene.sensor.axis_z = {0, -1, 0};
    scene.sensor.fov_x = static_cast<float>(pi / 2);
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 64;
    return scene;
}

// All pixels show 1/4096 of a square of side 2: half of them an area of 2, of a disk about the ground's corners.
TEST(PhotonSpread, IsTheAreaSeenOverTheDisk)
{
    for (const float half_width : {2.0f, 30.0f, 1000.0f})
        EXPECT_NEAR(share_of_distant_photons(ground(half_width)).value() * 2 * pi * double(half_width) * double(half_width), 2.0, 1e-3) << half_width;
}

TEST(PhotonSpread, IsSaidWithItsFigureBelowOneInAThousand)
{
    EXPECT_EQ(warn_of_spread_photons(ground(10.0f)), std::nullopt);
    const std::string warning = warn_of_spread_photons(ground(100.0f)).value_or("");
    EXPECT_THAT(warning, HasSubstr("ground.xml:7: "));
    EXPECT_THAT(warning, HasSubstr("1/31416")); // 2 pi 100^2 / 2
    EXPECT_THAT(warning, HasSubstr("-p photons=N"));
}

TEST(PhotonSpread, OnlyDistantLightsSpread)
{
    Scene scene = ground(1000.0f);
    scene.emitters = {{{}, PointEmitter{{0, 1, 0}, {1, 1, 1}}}};
    EXPECT_EQ(share_of_distant_photons(scene), std::nullopt);
    scene.emitters = {{{}, ConstantEmitter{{1, 1, 1}}}};
    EXPECT_TRUE(share_of_distant_photons(scene).has_value());
    scene.sensor.axis_z = {0, 1, 0}; // sees nothing
    EXPECT_EQ(share_of_distant_photons(scene), std::nullopt);
}

// Spheres, disks and cylinders of the same size fill the same pixels, near enough.
TEST(PhotonSpread, SeesEveryKindOfShape)
{
    const auto share_with = [](auto geometry) {
        Scene scene = ground(1000.0f);
        ShapeDescription shape;
        shape.geometry = geometry;
        scene.shapes.push_back(shape);
        return share_of_distant_photons(scene).value() / share_of_distant_photons(ground(1000.0f)).value();
    };
    // At half the height surfaces show a quarter of the area.
    EXPECT_NEAR(share_with(Disk{{0, .5f, 0}, {0, 0, 5}, {5, 0, 0}}), 0.25, 1e-3);
    EXPECT_LT(share_with(Sphere{{0, 0, 0}, 0.5f}), 0.95);
    EXPECT_LT(share_with(Cylinder{{0, 0, -2}, 0.5f, 4.0f}), 0.95);
}

TEST(PhotonSpread, IsFineInEveryShippedScene)
{
    for (const char* folder : {"gallery", "analytic"})
        for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() / "scenes" / folder)) {
            if (entry.path().extension() != ".xml") continue;
            EXPECT_EQ(warn_of_spread_photons(load_scene(entry.path(), {}).scene), std::nullopt) << entry.path();
        }
}

} // namespace
} // namespace sundog
