// What scenes of other renderers of the dialect say, and how it is understood here.
#include "unit/scene_folder.h"

#include <chrono>
#include <cmath>
#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;
using sundog::testing::load_with;
using sundog::testing::scene_with;
using sundog::testing::SceneFolder;
using ::testing::HasSubstr;

bool warns(const LoadedScene& loaded, const std::string& text)
{
    for (const Warning& warning : loaded.warnings)
        if (warning.text.find(text) != std::string::npos) return true;
    return false;
}

std::string parameter(const LoadedScene& loaded, const std::string& name)
{
    const auto& all = loaded.scene.integrator.parameters;
    const auto found = all.find(name);
    return found == all.end() ? "none" : found->second.value;
}

// --- Objects declared at the level of the scene --------------------------------

TEST(ImportDeclared, AreaLightThatShapesReferTo)
{
    const LoadedScene loaded =
        load_with("<emitter type=\"area\" id=\"L\"><rgb name=\"radiance\" value=\"2\"/></emitter><alias id=\"L\" as=\"M\"/>"
                  "<shape type=\"disk\"><ref id=\"L\"/></shape><shape type=\"sphere\"><ref id=\"M\"/></shape>");
    EXPECT_TRUE(loaded.warnings.empty());
    for (std::size_t i = 0; i < 2; i++) expect_near(loaded.scene.shapes.at(i).emitter.value().radiance, {2, 2, 2}, 0);
    EXPECT_TRUE(loaded.scene.emitters.empty());
}

TEST(ImportDeclared, PartsOfTheSensor)
{
    const LoadedScene loaded = SceneFolder().load(
        "<scene version=\"3.0.0\"><sampler type=\"independent\" id=\"s\"><integer name=\"sample_count\" value=\"7\"/></sampler>"
        "<rfilter type=\"tent\" id=\"r\"/><film type=\"hdrfilm\" id=\"f\"><integer name=\"width\" value=\"33\"/><ref id=\"r\"/></film>"
        "<sensor type=\"perspective\"><ref id=\"s\"/><ref id=\"f\"/></sensor><shape type=\"cube\"/><emitter type=\"constant\"/></scene>");
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.integrator.sample_count, 7);
    EXPECT_EQ(loaded.scene.film.width, 33);
    EXPECT_EQ(loaded.scene.film.filter.kind, FilterKind::tent);
}

// Nothing refers to them: they do not change the image, and that is said.
TEST(ImportDeclared, UnusedPartsOfTheSensor)
{
    const LoadedScene loaded = load_with("<sampler type=\"independent\" id=\"S\"><integer name=\"sample_count\" value=\"16\"/></sampler>");
    EXPECT_TRUE(warns(loaded, "sampler 'independent' is ignored: no sensor contains it or refers to it"));
    EXPECT_EQ(loaded.scene.integrator.sample_count, 0);
    EXPECT_TRUE(warns(load_with("<film type=\"hdrfilm\"/>"), "film 'hdrfilm' is ignored"));
}

TEST(ImportDeclared, IntegratorInsideAnotherByReference)
{
    const LoadedScene loaded = load_with("<integrator type=\"path\" id=\"p\"><integer name=\"max_depth\" value=\"3\"/></integrator>"
                                         "<integrator type=\"aov\"><ref id=\"p\"/></integrator>");
    EXPECT_EQ(loaded.scene.integrator.method, "path");
    EXPECT_TRUE(warns(loaded, "integrator 'aov' is ignored: the one inside it is rendered"));
    EXPECT_THROW(load_with("<integrator type=\"aov\" id=\"a\"><ref id=\"a\"/></integrator>"), SceneError);
}

// --- Folders -----------------------------------------------------------------

// <path> in an included file is looked for beside it, then beside the scene.
TEST(ImportFolders, PathInAnIncludedFile)
{
    const SceneFolder folder;
    folder.write("data/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("inc/part.xml", "<scene version=\"3.0.0\"><path value=\"data\"/>"
                                 "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape></scene>");
    const LoadedScene loaded = folder.load(scene_with("<path value=\"data\"/><include filename=\"inc/part.xml\"/>"));
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.shapes.size(), 2u);
}

TEST(ImportFolders, MissingFolderIsAWarning)
{
    const LoadedScene loaded = load_with("<path value=\"nowhere\"/>");
    EXPECT_TRUE(warns(loaded, "scene.xml:2: <path> is ignored: there is no folder"));
}

// --- Integrators ---------------------------------------------------------------

TEST(ImportIntegrators, DirectIsAPathOfTwoEdges)
{
    const LoadedScene loaded = load_with("<integrator type=\"direct\"><integer name=\"shadingSamples\" value=\"4\"/></integrator>");
    EXPECT_EQ(loaded.scene.integrator.method, "path");
    EXPECT_EQ(parameter(loaded, "max_depth"), "2");
    EXPECT_TRUE(warns(loaded, "'shading_samples' of integrator 'direct' is ignored: an iteration takes one sample"));
    EXPECT_TRUE(warns(loaded, "integrator 'direct' is rendered by path with max_depth 2"));
}

TEST(ImportIntegrators, VolumetricOnesWithoutMediaArePaths)
{
    for (const char* type : {"volpath", "volpath_simple", "volpathmis"}) {
        const LoadedScene loaded =
            load_with("<integrator type=\"" + std::string(type) + "\"><integer name=\"maxDepth\" value=\"7\"/></integrator>");
        EXPECT_EQ(loaded.scene.integrator.method, "path");
        EXPECT_EQ(parameter(loaded, "max_depth"), "7");
        EXPECT_EQ(loaded.warnings.size(), 1u);
    }
}

TEST(ImportIntegrators, PhotonMapperOfVersion06)
{
    const LoadedScene loaded = load_with(
        "<integrator type=\"photonmapper\"><integer name=\"directSamples\" value=\"16\"/><integer name=\"glossySamples\" value=\"32\"/>"
        "<integer name=\"globalPhotons\" value=\"250000\"/><integer name=\"causticPhotons\" value=\"0\"/>"
        "<integer name=\"volumePhotons\" value=\"250000\"/><float name=\"globalLookupRadius\" value=\"0.05\"/>"
        "<float name=\"causticLookupRadius\" value=\"0.0125\"/><integer name=\"lookupSize\" value=\"120\"/>"
        "<integer name=\"granularity\" value=\"0\"/><boolean name=\"hideEmitters\" value=\"false\"/></integrator>",
        {}, "0.6.0");
    EXPECT_EQ(parameter(loaded, "photons"), "250000");
    EXPECT_EQ(parameter(loaded, "caustic_photons"), "none") << "0 there leaves it to the method here";
    EXPECT_EQ(parameter(loaded, "lookup"), "nearest");
    EXPECT_EQ(parameter(loaded, "nearest"), "120");
    // Fractions of the radius of the scene, here sqrt(2): the square of side 2.
    EXPECT_NEAR(std::stod(parameter(loaded, "radius")), 0.05 * std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(std::stod(parameter(loaded, "caustic_radius")), 0.0125 * std::sqrt(2.0), 1e-6);
    EXPECT_EQ(loaded.scene.integrator.parameters.size(), 5u);
    EXPECT_EQ(loaded.warnings.size(), 6u);
}

TEST(ImportIntegrators, OthersOfVersion06)
{
    const auto load = [](const char* type, const std::string& inside) {
        return load_with("<integrator type=\"" + std::string(type) + "\">" + inside + "</integrator>", {}, "0.6.0");
    };
    LoadedScene loaded = load("bdpt", "<boolean name=\"lightImage\" value=\"false\"/><boolean name=\"sampleDirect\" value=\"true\"/>");
    EXPECT_TRUE(loaded.scene.integrator.parameters.empty());
    EXPECT_EQ(loaded.warnings.size(), 2u);

    loaded = load(
        "pssmlt",
        "<boolean name=\"bidirectional\" value=\"false\"/><integer name=\"luminanceSamples\" value=\"5000\"/>"
        "<float name=\"pLarge\" value=\"0.4\"/><boolean name=\"twoStage\" value=\"false\"/><integer name=\"directSamples\" value=\"-1\"/>");
    EXPECT_EQ(parameter(loaded, "paths"), "path");
    EXPECT_EQ(parameter(loaded, "seeds"), "5000");
    EXPECT_EQ(parameter(loaded, "large_step"), "0.4");
    EXPECT_EQ(loaded.scene.integrator.parameters.size(), 3u);
    EXPECT_EQ(loaded.warnings.size(), 2u);

    loaded = load("ptracer", "<boolean name=\"bruteForce\" value=\"true\"/>");
    EXPECT_TRUE(warns(loaded, "'brute_force' of integrator 'ptracer' is ignored"));

    loaded = load("sppm", "<integer name=\"photonCount\" value=\"1000\"/><integer name=\"maxPasses\" value=\"-1\"/><float "
                          "name=\"initialRadius\" value=\"0.5\"/>");
    EXPECT_EQ(parameter(loaded, "photons"), "1000");
    EXPECT_EQ(parameter(loaded, "radius"), "0.5");
    EXPECT_EQ(parameter(loaded, "iterations"), "none") << "-1 has no end";
}

TEST(ImportIntegrators, HiddenEmittersAreKeptForEveryMethod)
{
    EXPECT_TRUE(
        load_with("<integrator type=\"bdpt\"><boolean name=\"hideEmitters\" value=\"true\"/></integrator>").scene.integrator.hide_emitters);
    EXPECT_FALSE(load_with("<integrator type=\"bdpt\"><boolean name=\"hideEmitters\" value=\"false\"/></integrator>")
                     .scene.integrator.hide_emitters);
    EXPECT_TRUE(
        load_with(
            "<integrator type=\"aov\"><integrator type=\"path\"><boolean name=\"hide_emitters\" value=\"true\"/></integrator></integrator>")
            .scene.integrator.hide_emitters);
}

// Interpolated normals let no light through a face, whatever is asked.
TEST(ImportIntegrators, LaxNormalsAreSaidToBeStrict)
{
    EXPECT_TRUE(load_with("<integrator type=\"path\"><boolean name=\"strictNormals\" value=\"true\"/></integrator>").warnings.empty());
    const LoadedScene loaded = load_with("<integrator type=\"path\"><boolean name=\"strictNormals\" value=\"false\"/></integrator>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings.front().kind, WarningKind::approximated);
}

// --- Values ------------------------------------------------------------------

LoadedScene masked(const std::string& opacity)
{
    return load_with("<shape type=\"cube\"><bsdf type=\"mask\">" + opacity + "<bsdf type=\"diffuse\"/></bsdf></shape>", {}, "0.6.0");
}

TEST(ImportValues, GrayColoursAreNumbers)
{
    for (const char* tag : {"spectrum", "rgb"}) {
        const LoadedScene loaded = load_with("<shape type=\"cube\"><bsdf type=\"roughconductor\"><" + std::string(tag) +
                                                 " name=\"alpha\" value=\"0.25\"/></bsdf></shape>",
                                             {}, "0.6.0");
        EXPECT_TRUE(loaded.warnings.empty());
        EXPECT_EQ(std::get<ConductorBsdf>(loaded.scene.bsdfs.at(0).model).roughness.value().alpha_u.value, 0.25f);
        EXPECT_TRUE(masked("<" + std::string(tag) + " name=\"opacity\" value=\"0.25\"/>").warnings.empty());
    }
    EXPECT_THROW(masked("<rgb name=\"opacity\" value=\"2\"/>"), SceneError);
    EXPECT_THROW(masked("<rgb name=\"opacity\" value=\"-1\"/>"), SceneError);
}

TEST(ImportValues, ColouredRoughnessCountsByItsLuminance)
{
    const LoadedScene loaded =
        load_with("<shape type=\"cube\"><bsdf type=\"roughconductor\"><rgb name=\"alpha\" value=\"0.5, 0.25, 0\"/></bsdf></shape>");
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.warnings.front().kind, WarningKind::approximated);
    EXPECT_NEAR(std::get<ConductorBsdf>(loaded.scene.bsdfs.at(0).model).roughness.value().alpha_u.value, 0.5 * 0.212671 + 0.25 * 0.715160,
                1e-4);
}

TEST(ImportValues, SpectrumOfThreeNumbersIsRgb)
{
    const LoadedScene loaded =
        load_with("<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"1, .5, .25\"/></emitter>", {}, "0.6.0");
    expect_near(std::get<ConstantEmitter>(loaded.scene.emitters.at(0).model).radiance, {1, 0.5f, 0.25f}, 0);
    EXPECT_THROW(load_with("<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"1, .5\"/></emitter>"), SceneError);
}

TEST(ImportValues, RoughnessAboveOne)
{
    const LoadedScene loaded =
        load_with("<shape type=\"cube\"><bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"1.2\"/></bsdf></shape>");
    EXPECT_EQ(std::get<ConductorBsdf>(loaded.scene.bsdfs.at(0).model).roughness.value().alpha_u.value, 1.2f);
}

TEST(ImportValues, LightsWithoutShapes)
{
    const LoadedScene loaded =
        SceneFolder().load("<scene version=\"3.0.0\"><sensor type=\"perspective\"/><emitter type=\"constant\"/></scene>");
    EXPECT_TRUE(loaded.scene.shapes.empty());
    EXPECT_TRUE(warns(loaded, "the scene has no <shape>"));
}

// --- Encodings -----------------------------------------------------------------

// Each character of ASCII in two bytes, and what is beyond as it comes.
std::string utf16(const std::u16string& text, bool big_endian)
{
    std::string bytes;
    for (const char16_t c : text) {
        const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
        bytes += big_endian ? high : low;
        bytes += big_endian ? low : high;
    }
    return bytes;
}

const std::u16string wide_scene = u"<?xml version=\"1.0\" encoding=\"utf-16\"?>\n<!-- caf\u00e9 \U0001f600 -->\n<scene version=\"3.0.0\">\n"
                                  u"<bsdf type=\"diffuse\" id=\"caf\u00e9\"/><shape type=\"cube\"><ref id=\"caf\u00e9\"/></shape>\n"
                                  u"<sensor type=\"perspective\"/><emitter type=\"constant\"/>";

TEST(ImportEncodings, Utf16WithAndWithoutAMark)
{
    const SceneFolder folder;
    for (const bool big_endian : {false, true})
        for (const std::u16string mark : {u"\ufeff", u""}) {
            const LoadedScene loaded = folder.load(utf16(mark + wide_scene + u"</scene>", big_endian));
            EXPECT_EQ(loaded.scene.bsdfs.at(0).id, "caf\xc3\xa9");
            try {
                folder.load(utf16(mark + wide_scene + u"\n<teapot/></scene>", big_endian));
                FAIL() << "loaded";
            } catch (const SceneError& error) {
                EXPECT_THAT(error.what(), HasSubstr("scene.xml:6: ")) << "lines are those of the text";
            }
        }
}

TEST(ImportEncodings, ThoseThatTheDeclarationNames)
{
    const auto declared = [](const std::string& encoding, const std::string& e_acute) {
        return "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?>\n" +
               scene_with("<bsdf type=\"diffuse\" id=\"caf" + e_acute + "\"/><shape type=\"cube\"><ref id=\"caf" + e_acute +
                          "\"/></shape>");
    };
    for (const auto& [encoding, e_acute] : {std::pair("ISO-8859-1", "\xe9"), std::pair("windows-1252", "\xe9"),
                                            std::pair("UTF-8", "\xc3\xa9"), std::pair("utf8", "\xc3\xa9")})
        EXPECT_EQ(SceneFolder().load(declared(encoding, e_acute)).scene.bsdfs.at(0).id, "caf\xc3\xa9") << encoding;
    EXPECT_EQ(SceneFolder().load("\xef\xbb\xbf" + declared("utf-8", "\xc3\xa9")).scene.bsdfs.at(0).id, "caf\xc3\xa9");
    EXPECT_THROW(SceneFolder().load(declared("UTF-8//IGNORE", "\xe9")), SceneError);
}

// --- Hostile files ---------------------------------------------------------------

// Each took time that grows with the square of its size.
TEST(ImportHostile, ManyNamesAreReadInTime)
{
    const SceneFolder folder;
    std::string attributes = "<scene version=\"3.0.0\"><shape type=\"cube\"", parameters = "<integrator type=\"path\">", defaults;
    for (int i = 0; i < 100'000; i++) {
        const std::string name = std::to_string(i);
        attributes += " a" + name + "=\"\"";
        parameters += "<float name=\"p" + name + "\" value=\"1\"/>";
        defaults += "<default name=\"d" + name + "\" value=\"1\"/><bsdf type=\"diffuse\" id=\"$d" + name + "_" + name + "\"/>";
    }
    const auto begin = std::chrono::steady_clock::now();
    folder.load(attributes + "/><sensor type=\"perspective\"/><emitter type=\"constant\"/></scene>");
    EXPECT_EQ(folder.load(scene_with(parameters + "</integrator>")).scene.integrator.parameters.size(), 100'000u);
    folder.load(scene_with(defaults));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30)) << "10^10 comparisons take minutes";
}

// A name cannot begin a line of its own in the messages, nor command the terminal.
TEST(ImportHostile, ControlCharactersInNamesAreEscaped)
{
    try {
        load_with("<shape type=\"tea&#10;pot&#27;[31m\"/>");
        FAIL() << "loaded";
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("tea\\npot\\x1b[31m"));
    }
    const LoadedScene loaded = load_with("<shape type=\"cube\"><float name=\"wob&#9;ble&#x9b;2J\" value=\"1\"/></shape>");
    EXPECT_TRUE(warns(loaded, "'wob\\tble\\x9b2j'"));
}

} // namespace
