// Shape groups and instances of scene files.
#include "unit/scene_folder.h"

#include "scene/flat_scene.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using namespace sundog::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string group = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\"/><shape type=\"sphere\"><bsdf type=\"conductor\"/></shape></shape>";
const std::string instance = "<shape type=\"instance\"><ref id=\"g\"/>";

TEST(ImportInstances, GroupsAreStoredOnce)
{
    const auto loaded = load_with(group + instance + "<transform name=\"to_world\"><scale x=\"-2\" y=\"1\" z=\"1\"/><translate x=\"5\"/></transform></shape>" + instance +
                                  "</shape>");
    const Scene& scene = loaded.scene;
    EXPECT_THAT(loaded.warnings, IsEmpty());
    ASSERT_EQ(scene.groups.size(), 1u);
    EXPECT_EQ(scene.groups[0].id, "g");
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_EQ(scene.shapes[0].group, 0u);
    EXPECT_EQ(scene.shapes[1].group, 0u);
    EXPECT_FALSE(scene.shapes[2].group) << "the lit rectangle";
    EXPECT_TRUE(std::holds_alternative<ConductorBsdf>(scene.bsdfs[scene.shapes[1].bsdf].model));
    ASSERT_EQ(scene.instances.size(), 2u);
    expect_near(scene.instances[0].to_world.at(0).point({1, 1, 1}), {3, 1, 1}, 1e-6f);
    expect_near(scene.instances[1].to_world.at(0).point({1, 2, 3}), {1, 2, 3}, 0);
    EXPECT_EQ(scene.triangle_count(), 14u);
    EXPECT_EQ(scene.triangle_count_with_copies(), 26u);
    expect_near(scene.bounds().lower, {-1, -1, -1}, 1e-5f);
    expect_near(scene.bounds().upper, {7, 1, 1}, 1e-5f);
}

TEST(ImportInstances, AnyOrderAndLegacyNames)
{
    const auto loaded = load_with(instance + "<transform name=\"toWorld\"><translate x=\"5\"/></transform></shape>" + group, {}, "0.6.0");
    ASSERT_EQ(loaded.scene.instances.size(), 1u);
    expect_near(loaded.scene.instances[0].to_world.at(0).point({0, 0, 0}), {5, 0, 0}, 0);
}

TEST(ImportInstances, GroupsWithoutInstancesAreNamed)
{
    const auto loaded = load_with(group);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("scene.xml:2: shapegroup 'g' has no instance")));
    EXPECT_EQ(loaded.scene.shapes.size(), 1u);
}

// Primitives of the world come first, then group by group, wherever the file has them.
TEST(ImportInstances, RangesFollowTheGroups)
{
    const auto loaded = load_with(instance + "</shape>" + group + "<shape type=\"sphere\"/><shape type=\"shapegroup\" id=\"h\"><shape type=\"rectangle\"/></shape>"
                                  "<shape type=\"instance\"><ref id=\"h\"/></shape>");
    const FlatScene flat = flatten_scene(loaded.scene);
    EXPECT_EQ(flat.world.triangle_count, 2u);
    EXPECT_EQ(flat.world.analytic_count, 1u);
    ASSERT_EQ(flat.groups.size(), 2u);
    EXPECT_EQ(flat.groups[0].first_triangle, 2u);
    EXPECT_EQ(flat.groups[0].triangle_count, 12u);
    EXPECT_EQ(flat.groups[0].first_analytic, 1u);
    EXPECT_EQ(flat.groups[0].analytic_count, 1u);
    EXPECT_EQ(flat.groups[1].first_triangle, 14u);
    EXPECT_EQ(flat.groups[1].triangle_count, 2u);
    EXPECT_EQ(flat.instance_groups, (std::vector<uint>{0, 1}));
    for (std::size_t i = 0; i < flat.triangles.size(); i++) {
        const Shape& shape = flat.shapes[flat.triangles[i].shape];
        EXPECT_LE(shape.first_primitive, i);
        EXPECT_EQ(loaded.scene.shapes[flat.triangles[i].shape].group.has_value(), i >= 2) << i;
    }
}

struct Broken {
    const char* name;
    const char* message;
    std::string xml;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
    *out << broken.name;
}

class BrokenInstances : public ::testing::TestWithParam<Broken>
{
};

TEST_P(BrokenInstances, AreRefusedWithTheirLine)
{
    try {
        load_with(GetParam().xml);
        FAIL() << "accepted";
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::string("scene.xml:") + GetParam().message));
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenInstances,
    ::testing::Values(Broken{"NoReference", "2: the instance names no shapegroup", "<shape type=\"instance\"/>"},
                      Broken{"UnknownId", "3: reference to unknown id 'g'", "<shape type=\"instance\">\n<ref id=\"g\"/></shape>"},
                      Broken{"NotAGroup", "4: an instance needs a shapegroup", "<shape type=\"cube\" id=\"g\"/>\n<shape type=\"instance\">\n<ref id=\"g\"/></shape>"},
                      Broken{"TwoGroups", "5: ", group + "<shape type=\"shapegroup\" id=\"h\"><shape type=\"cube\"/></shape>\n" + "\n" + instance + "\n<ref id=\"h\"/></shape>"},
                      Broken{"EmptyGroup", "2: the shapegroup is empty", "<shape type=\"shapegroup\" id=\"g\"/>\n" + instance + "</shape>"},
                      Broken{"GroupInGroup", "3: a shapegroup cannot hold", "<shape type=\"shapegroup\" id=\"g\">\n<shape type=\"shapegroup\"><shape type=\"cube\"/></shape></shape>" + instance + "</shape>"},
                      Broken{"InstanceInGroup", "4: a shapegroup cannot hold",
                             "<shape type=\"shapegroup\" id=\"h\"><shape type=\"cube\"/></shape>\n<shape type=\"shapegroup\" id=\"g\">\n<shape type=\"instance\"><ref id=\"h\"/></shape></shape>" + instance + "</shape>"},
                      Broken{"EmitterInGroup", "4: a light cannot be inside a shapegroup",
                             "<shape type=\"shapegroup\" id=\"g\">\n<shape type=\"cube\">\n<emitter type=\"area\"/></shape></shape>" + instance + "</shape>"},
                      Broken{"BsdfOfInstance", "3: bsdf plugin 'diffuse' is not supported in", group + instance + "\n<bsdf type=\"diffuse\"/></shape>"},
                      Broken{"BrokenMember", "3: shape plugin 'teapot'", "<shape type=\"shapegroup\" id=\"g\">\n<shape type=\"teapot\"/></shape>" + instance + "</shape>"},
                      Broken{"FlatInstance", "3: the transform flattens space", group + instance + "<transform name=\"to_world\">\n<scale x=\"0\"/></transform></shape>"}),
    [](const auto& broken) { return broken.param.name; });

} // namespace
