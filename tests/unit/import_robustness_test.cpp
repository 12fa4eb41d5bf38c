// Damaged scenes: whatever the damage, either a scene or a SceneError comes out.
#include "unit/scene_folder.h"

#include <random>

namespace
{

using namespace sundog;
using sundog::testing::SceneFolder;

const std::string whole = R"(<?xml version="1.0" encoding="utf-8"?>
<scene version="3.0.0"><default name="w" value="64"/>
<integrator type="sppm"><integer name="max_depth" value="10"/></integrator>
<sensor type="thinlens"><float name="fov" value="40"/><float name="aperture_radius" value=".1"/><float name="shutter_close" value="1"/>
<transform name="to_world"><lookat origin="0, 1, 5" target="0, 0, 0" up="0, 1, 0"/><rotate x="1" angle="3"/></transform>
<film type="hdrfilm"><integer name="width" value="$w"/><integer name="height" value="48"/><rfilter type="tent"/></film></sensor>
<bsdf type="twosided" id="m"><bsdf type="diffuse"><spectrum name="reflectance" value="400:.1, 700:.9"/></bsdf></bsdf>
<shape type="obj"><string name="filename" value="m.obj"/><ref id="m"/></shape><alias id="m" as="n"/>
<shape type="sphere"><point name="center" x="1"/><bsdf type="dielectric"><string name="int_ior" value="bk7"/></bsdf></shape>
<shape type="disk"><emitter type="area"><blackbody name="radiance" temperature="5000K"/></emitter><ref id="n"/></shape>
<shape type="cube"><animation name="to_world"><transform time="0"/><transform time="1.5"><rotate y="1" angle="170"/><scale x="2"/></transform>
</animation></shape><include filename="i.xml"/></scene>
)";

void write_parts(const SceneFolder& folder)
{
    folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
    folder.write("i.xml", "<emitter type=\"point\"/>");
}

// Whether it loaded. Anything but a SceneError escapes and fails the test.
bool loads(const SceneFolder& folder, const std::string& xml)
{
    try {
        folder.load(xml).scene.bounds(); // of all that moves
        return true;
    } catch (const SceneError&) {
        return false;
    }
}

TEST(ImportRobustness, TruncationAnywhere)
{
    const SceneFolder folder;
    write_parts(folder);
    ASSERT_TRUE(loads(folder, whole));
    const std::size_t end = whole.find("</scene>") + 8;
    for (std::size_t size = 0; size < end; size++) EXPECT_FALSE(loads(folder, whole.substr(0, size))) << size;
    EXPECT_TRUE(loads(folder, whole.substr(0, end)));
}

TEST(ImportRobustness, RandomBytes)
{
    const SceneFolder folder;
    write_parts(folder);
    std::mt19937 random(20240607);
    int loaded = 0;
    constexpr int trials = 1000;
    for (int trial = 0; trial < trials; trial++) {
        std::string xml = whole;
        const int flips = 1 + static_cast<int>(random() % 4);
        for (int i = 0; i < flips; i++) xml[random() % xml.size()] = static_cast<char>(random());
        loaded += loads(folder, xml) ? 1 : 0;
    }
    EXPECT_GT(loaded, 0) << "some damage is harmless";
    EXPECT_LT(loaded, trials);
}

// Characters that mean something to the parsers are swapped for one another.
TEST(ImportRobustness, RandomTokens)
{
    const SceneFolder folder;
    write_parts(folder);
    std::mt19937 random(7);
    const std::string alphabet = "<>/\"= $0123456789.-e:,#";
    for (int trial = 0; trial < 1000; trial++) {
        std::string xml = whole;
        for (int i = 0; i < 3; i++) {
            std::size_t at = random() % xml.size();
            while (alphabet.find(xml[at]) == std::string::npos) at = random() % xml.size();
            xml[at] = alphabet[random() % alphabet.size()];
        }
        loads(folder, xml);
    }
}

TEST(ImportRobustness, RandomMeshBytes)
{
    const SceneFolder folder;
    write_parts(folder);
    const std::string obj =
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 2\nvt 0 0\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1 4/1/1 5/1/1\n";
    folder.write("m.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
    const std::string xml = sundog::testing::scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape>");
    std::mt19937 random(99);
    int loaded = 0;
    for (int trial = 0; trial < 500; trial++) {
        std::string damaged = obj;
        for (int i = 0; i < 2; i++) damaged[random() % damaged.size()] = static_cast<char>(random());
        folder.write("m.obj", damaged);
        loaded += loads(folder, xml) ? 1 : 0;
    }
    EXPECT_GT(loaded, 0);
}

TEST(ImportRobustness, RandomPlyBytes)
{
    const SceneFolder folder;
    std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const auto put = [&](auto value) { ply.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    for (float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) put(c);
    for (int first : {0, 1}) {
        put(static_cast<unsigned char>(3));
        for (int i : {0, 1, 2}) put(first + i);
    }
    const std::string xml = sundog::testing::scene_with("<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/></shape>");
    std::mt19937 random(5);
    int loaded = 0;
    for (int trial = 0; trial < 400; trial++) {
        std::string damaged = ply;
        damaged[random() % damaged.size()] = static_cast<char>(random());
        folder.write("m.ply", damaged);
        loaded += loads(folder, xml) ? 1 : 0;
    }
    EXPECT_GT(loaded, 0);
}

} // namespace
