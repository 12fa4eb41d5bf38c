// Nothing in a scene file is passed over in silence: an unknown parameter of any object is named with its line, and each
// warning says whether something was ignored or approximated.
#include "unit/scene_folder.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::SceneFolder;
using ::testing::HasSubstr;

constexpr const char* bogus = "\n<float name=\"bogus\" value=\"1\"/>\n"; // alone on its line

std::string mesh(const std::string& type, const std::string& file, const std::string& inside)
{
    return "<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + file + "\"/>" + inside + "</shape>";
}

std::string bsdf(const std::string& type, const std::string& inside)
{
    return "<shape type=\"rectangle\"><bsdf type=\"" + type + "\">" + inside + "</bsdf></shape>";
}

std::string texture(const std::string& type, const std::string& inside)
{
    return bsdf("diffuse", "<texture name=\"reflectance\" type=\"" + type + "\">" + inside + "</texture>");
}

// Every plugin that is supported, with the parameter inside it.
std::vector<std::string> objects_with(const std::string& parameter)
{
    std::vector<std::string> objects = {mesh("obj", "m.obj", parameter), mesh("ply", "m.ply", parameter)};
    for (const char* type : {"rectangle", "cube", "sphere", "disk", "cylinder"})
        objects.push_back("<shape type=\"" + std::string(type) + "\">" + parameter + "</shape>");
    for (const char* type : {"diffuse", "dielectric", "thindielectric", "roughdielectric", "conductor", "roughconductor", "null"})
        objects.push_back(bsdf(type, parameter));
    for (const char* type : {"mask", "twosided"}) objects.push_back(bsdf(type, "<bsdf type=\"diffuse\"/>" + parameter));
    objects.push_back(bsdf("blendbsdf", "<bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/>" + parameter));
    objects.push_back(texture("checkerboard", parameter));
    objects.push_back(texture("mesh_attribute", "<string name=\"name\" value=\"vertex_color\"/>" + parameter));
    objects.push_back(texture("scale", "<texture type=\"checkerboard\"/>" + parameter));
#ifndef SUNDOG_MINIMAL
    objects.push_back(texture("bitmap", "<string name=\"filename\" value=\"b.ppm\"/>" + parameter));
#endif
    for (const char* type : {"point", "spot", "directional", "constant"})
        objects.push_back("<emitter type=\"" + std::string(type) + "\">" + parameter + "</emitter>");
    objects.push_back("<shape type=\"disk\"><emitter type=\"area\">" + parameter + "</emitter></shape>");
    for (const char* type : {"uniform", "blackbody"})
        objects.push_back("<emitter type=\"constant\"><spectrum name=\"radiance\" type=\"" + std::string(type) +
                          "\"><float name=\"value\" value=\"1\"/><float name=\"temperature\" value=\"5000\"/>" + parameter +
                          "</spectrum></emitter>");
    return objects;
}

// Sensors and what is in them; the scene has one.
std::vector<std::string> sensors_with(const std::string& parameter)
{
    std::vector<std::string> sensors;
    for (const char* type : {"perspective", "orthographic", "thinlens", "telecentric"})
        sensors.push_back("<sensor type=\"" + std::string(type) + "\"><float name=\"aperture_radius\" value=\".1\"/>" + parameter +
                          "</sensor>");
    for (const char* type : {"hdrfilm", "ldrfilm", "tiledhdrfilm", "mfilm"})
        sensors.push_back("<sensor type=\"perspective\"><film type=\"" + std::string(type) + "\">" + parameter + "</film></sensor>");
    for (const char* type : {"box", "tent", "gaussian", "mitchell", "catmullrom"})
        sensors.push_back("<sensor type=\"perspective\"><film type=\"hdrfilm\"><rfilter type=\"" + std::string(type) + "\">" + parameter +
                          "</rfilter></film></sensor>");
    for (const char* type : {"independent", "ldsampler"})
        sensors.push_back("<sensor type=\"perspective\"><sampler type=\"" + std::string(type) + "\">" + parameter + "</sampler></sensor>");
    return sensors;
}

SceneFolder& folder()
{
    static SceneFolder files;
    files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    files.write("m.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n");
    files.write("b.ppm", "P3\n1 1\n255\n1 2 3\n");
    return files;
}

void expect_bogus_is_named(const std::string& xml)
{
    SCOPED_TRACE(xml);
    const auto line = 1 + std::count(xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(xml.find("\"bogus\"")), '\n');
    const LoadedScene loaded = folder().load(xml);
    const auto named = std::count_if(loaded.warnings.begin(), loaded.warnings.end(), [&](const Warning& warning) {
        return warning.kind == WarningKind::ignored && warning.text.find("scene.xml:" + std::to_string(line) + ": ") != std::string::npos &&
               warning.text.find("'bogus'") != std::string::npos;
    });
    EXPECT_EQ(named, 1);
}

TEST(ImportWarnings, UnknownParametersOfEveryPlugin)
{
    for (const std::string& object : objects_with(bogus)) expect_bogus_is_named(sundog::testing::scene_with(object));
    for (const std::string& sensor : sensors_with(bogus))
        expect_bogus_is_named("<scene version=\"3.0.0\">\n" + sensor +
                              "<shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>");
    expect_bogus_is_named(sundog::testing::scene_with(bogus)); // of the scene itself
}

// An integrator's parameters are its method's to judge, so they are kept, with their line.
TEST(ImportWarnings, ParametersOfIntegratorsAreKept)
{
    const LoadedScene loaded =
        folder().load(sundog::testing::scene_with("<integrator type=\"path\">" + std::string(bogus) + "</integrator>"));
    EXPECT_EQ(loaded.scene.integrator.parameters.at("bogus").where.line, 3);
}

TEST(ImportWarnings, KindsTellIgnoredFromApproximated)
{
    const auto kind_of = [](const std::string& inside) {
        const LoadedScene loaded = folder().load(sundog::testing::scene_with(inside));
        EXPECT_EQ(loaded.warnings.size(), 1u) << inside;
        return loaded.warnings.at(0).kind;
    };
    EXPECT_EQ(kind_of(bsdf("roughconductor", "<boolean name=\"sample_visible\" value=\"true\"/>")), WarningKind::ignored);
    EXPECT_EQ(kind_of(bsdf("diffuse", "<rgb name=\"reflectance\" value=\"2, 0, 0\"/>")), WarningKind::approximated);
    EXPECT_EQ(kind_of("<emitter type=\"point\"><rgb name=\"intensity\" value=\"0\"/></emitter>"), WarningKind::note);
}

} // namespace
