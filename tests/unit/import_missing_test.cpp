// What stands in for plugins that are not supported: nothing unless it is asked for, and then one warning each.
#include "scene_folder.h"

#include <gmock/gmock.h>

namespace sundog::testing
{
namespace
{

using ::testing::HasSubstr;

LoadOptions allowing()
{
    LoadOptions options;
    options.allow_missing = true;
    return options;
}

struct Case {
    const char* name;
    const char* inside;
    const char* warning; // with the line
};

class Missing : public ::testing::TestWithParam<Case>
{
};

TEST_P(Missing, IsAnErrorThatSaysHowToGoOn)
{
    try {
        load_with(GetParam().inside);
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("--allow-missing"));
    }
}

TEST_P(Missing, IsOneWarningWhereItIsAllowed)
{
    const auto loaded = load_with(GetParam().inside, allowing());
    ASSERT_EQ(loaded.warnings.size(), 1u) << loaded.warnings.at(0).text;
    EXPECT_THAT(loaded.warnings[0].text, HasSubstr(GetParam().warning));
    EXPECT_EQ(loaded.warnings[0].kind, WarningKind::approximated);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Missing,
    ::testing::Values(
        Case{"Bsdf", R"(<shape type="sphere"><bsdf type="hair"><float name="melanin" value="1"/><bsdf type="glitter"/></bsdf></shape>)",
             "scene.xml:2: bsdf plugin 'hair' is not supported: a diffuse bsdf of reflectance 0.5 stands in for it"},
        Case{"UnknownBsdf", R"(<bsdf type="glitter" id="g"/><shape type="sphere"><ref id="g"/></shape><shape type="cube"><ref id="g"/></shape>)",
             "scene.xml:2: bsdf plugin 'glitter' is not supported"},
        Case{"NestedBsdf", R"(<shape type="sphere"><bsdf type="twosided"><bsdf type="hair"/></bsdf></shape>)", "bsdf plugin 'hair'"},
        Case{"Texture", R"(<shape type="sphere"><bsdf type="diffuse"><texture name="reflectance" type="wireframe"/></bsdf></shape>)",
             "scene.xml:2: texture plugin 'wireframe' is not supported: a grey of 0.5 stands in for it"},
        Case{"Shape", R"(<shape type="hair"><string name="filename" value="nowhere.hair"/><bsdf type="hair"/></shape>)",
             "scene.xml:2: shape plugin 'hair' is not supported: it is left out"},
        Case{"Emitter", R"(<emitter type="laser"><float name="watts" value="5"/></emitter>)", "scene.xml:2: emitter plugin 'laser' is not supported: it is left out"},
        Case{"AreaEmitter", R"(<shape type="sphere"><emitter type="directionalarea"/></shape>)", "scene.xml:2: emitter plugin 'directionalarea'"},
        Case{"Medium", R"(<shape type="sphere"><medium name="interior" type="homogeneous"><float name="albedo" value="1"/></medium></shape>)",
             "scene.xml:2: medium plugin 'homogeneous' is not supported: it is left out"},
        Case{"Subsurface", R"(<shape type="sphere"><subsurface type="dipole"/></shape>)", "subsurface plugin 'dipole' is not supported: it is left out"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(MissingStandIns, AreGreyOrAbsent)
{
    const Scene scene = load_with(R"(<shape type="sphere"><bsdf type="hair"/></shape><shape type="hair"/><emitter type="laser"/>)", allowing()).scene;
    ASSERT_EQ(scene.shapes.size(), 2u); // the rectangle that is always there, too
    EXPECT_EQ(std::get<DiffuseBsdf>(scene.bsdfs[scene.shapes[0].bsdf].model).reflectance.value, (Vec3{0.5f, 0.5f, 0.5f}));
    EXPECT_TRUE(scene.emitters.empty());
}

// A group whose only shape is left out is empty, and so are its instances.
TEST(MissingStandIns, LeaveGroupsEmpty)
{
    const auto loaded = load_with(R"(<shape type="shapegroup" id="g"><shape type="hair"/></shape><shape type="instance"><ref id="g"/></shape>)", allowing());
    EXPECT_TRUE(loaded.scene.instances.empty());
    EXPECT_TRUE(loaded.scene.groups.empty());
}

} // namespace
} // namespace sundog::testing
