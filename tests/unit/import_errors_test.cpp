// Broken scenes, each with the line and the word that its message must have.
#include "unit/scene_folder.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::SceneFolder;
using ::testing::HasSubstr;

struct Broken {
    const char* name;
    int line; // in scene.xml; 0: the file as a whole
    const char* word;
    std::string xml;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
    *out << broken.name;
}

// `inside` starts on line 2.
std::string scene(const std::string& inside)
{
    return "<scene version=\"3.0.0\">\n" + inside +
           "\n<sensor type=\"perspective\"/><shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>\n";
}

std::string sensor(const std::string& inside, const std::string& type = "perspective")
{
    return "<scene version=\"3.0.0\"><sensor type=\"" + type + "\">\n" + inside +
           "\n</sensor><shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>\n";
}

std::string film(const std::string& inside)
{
    return sensor("<film type=\"hdrfilm\">\n" + inside + "</film>");
}

std::string bsdf(const std::string& inside)
{
    return scene("<shape type=\"sphere\">\n" + inside + "</shape>");
}

std::string move(const std::string& operation)
{
    return scene("<shape type=\"cube\"><transform name=\"to_world\">\n" + operation + "</transform></shape>");
}

const std::string light = "<shape type=\"rectangle\"><emitter type=\"area\"/></shape>";

const std::vector<Broken> broken_scenes = {
    // XML
    {"Empty", 0, "no XML element", ""},
    {"NotXml", 0, "no XML element", "hello\nworld"},
    {"Truncated", 2, "truncated", "<scene version=\"3.0.0\">\n<sensor type=\"perspective\">\n"},
    {"TruncatedTag", 2, "truncated", "<scene version=\"3.0.0\">\n<shape ty"},
    {"Mismatch", 3, "does not match", "<scene version=\"3.0.0\">\n<shape>\n</shap>\n</scene>\n"},
    {"UnquotedAttribute", 2, "attribute", "<scene version=\"3.0.0\">\n<shape type=sphere/></scene>"},
    {"OpenComment", 3, "comment", "<scene version=\"3.0.0\">\n<!-- never\nclosed"},
    {"WrongRoot", 1, "<scene>", "<shape type=\"sphere\"/>"},
    {"SecondRoot", 2, "second root", "<scene version=\"3.0.0\"></scene>\n<scene/>"},
    {"BadVersion", 1, "version", "<scene version=\"three\"></scene>"},
    {"Text", 2, "unexpected text", scene("hello")},
    {"UnknownTag", 2, "<spehre>", scene("<spehre/>")},
    {"AttributeTwice", 2, "twice", scene("<shape type=\"cube\" type=\"disk\"/>")},
    {"TooDeep", 1, "deeper",
     [] {
         std::string xml = "<scene version=\"3.0.0\">";
         for (int i = 0; i < 100; i++) xml += "<bsdf type=\"twosided\">";
         for (int i = 0; i < 100; i++) xml += "</bsdf>";
         return xml + "</scene>";
     }()},
    // Parameters, references, includes
    {"UndefinedParameter", 2, "-D size", scene("<shape type=\"sphere\"><float name=\"radius\" value=\"$size\"/></shape>")},
    {"LoneDollar", 2, "undefined", scene("<shape type=\"$\"/>")},
    {"DefaultWithoutValue", 2, "<default>", scene("<default name=\"a\"/>")},
    {"UnknownReference", 2, "unknown id 'glass'", scene("<shape type=\"cube\"><ref id=\"glass\"/></shape>")},
    {"ReferenceWithoutId", 2, "needs the attribute id", scene("<shape type=\"cube\"><ref name=\"glass\"/></shape>")},
    {"IdTwice", 3, "taken already", scene("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>")},
    {"AliasCircle", 3, "circle",
     scene("<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"a\"/>\n<shape type=\"cube\"><ref id=\"a\"/></shape>")},
    {"AliasOfNothing", 3, "unknown id", scene("<alias id=\"a\" as=\"b\"/>\n<shape type=\"cube\"><ref id=\"b\"/></shape>")},
    {"MissingInclude", 2, "'", scene("<include filename=\"nowhere.xml\"/>")},
    {"SelfInclude", 2, "cyclic <include>: scene.xml includes scene.xml", scene("<include filename=\"scene.xml\"/>")},
    {"ParameterTwice", 3, "given twice", bsdf("<float name=\"radius\" value=\"1\"/><float name=\"radius\" value=\"2\"/>")},
    // Values
    {"NotANumber", 3, "'abc'", bsdf("<float name=\"radius\" value=\"abc\"/>")},
    {"InfiniteNumber", 3, "finite", bsdf("<float name=\"radius\" value=\"inf\"/>")},
    {"NanNumber", 3, "finite", bsdf("<float name=\"radius\" value=\"nan\"/>")},
    {"OverflowingNumber", 3, "too large", bsdf("<float name=\"radius\" value=\"1e300\"/>")},
    {"TrailingText", 3, "'1m'", bsdf("<float name=\"radius\" value=\"1m\"/>")},
    {"FractionalInteger", 3, "whole number", film("<integer name=\"width\" value=\"1.5\"/>")},
    {"HugeInteger", 3, "out of range", film("<integer name=\"width\" value=\"99999999999\"/>")},
    {"WrongType", 3, "must be a <integer>", film("<float name=\"width\" value=\"100\"/>")},
    {"BadBoolean", 3, "true or false", bsdf("<boolean name=\"flip_normals\" value=\"yes\"/>")},
    {"TwoNumbers", 3, "one or three", bsdf("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1 2\"/></bsdf>")},
    {"BadHex", 3, "#rrggbb", bsdf("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"#12345\"/></bsdf>")},
    {"BadSpectrumPair", 3, "wavelength:value", bsdf("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"400:1, 500\"/></bsdf>")},
    {"FallingWavelengths", 3, "increase", bsdf("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"500:1, 400:1\"/></bsdf>")},
    {"ColdBlackBody", 2, "temperature", scene("<emitter type=\"point\"><blackbody name=\"intensity\" temperature=\"-3\"/></emitter>")},
    {"UnknownAttribute", 3, "'vlaue'", bsdf("<float name=\"radius\" vlaue=\"1\"/>")},
    {"NamelessValue", 3, "attribute name", bsdf("<float value=\"1\"/>")},
    {"Texture", 3, "texture plugin 'wood'", bsdf("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"wood\"/></bsdf>")},
    {"UnknownSpectrum", 2, "spectrum plugin 'rainbow'",
     scene("<emitter type=\"constant\"><spectrum name=\"radiance\" type=\"rainbow\"/></emitter>")},
    // Transforms
    {"ZeroScale", 3, "flattens", move("<scale x=\"0\"/>")},
    {"RotateWithoutAxis", 3, "axis", move("<rotate angle=\"3\" x=\"0\"/>")},
    {"RotateWithoutAngle", 3, "angle", move("<rotate y=\"1\"/>")},
    {"ShortMatrix", 3, "16 or 9", move("<matrix value=\"1 2 3\"/>")},
    {"PerspectiveMatrix", 3, "last row", move("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>")},
    {"LookAtItself", 3, "lookat", move("<lookat origin=\"1 2 3\" target=\"1 2 3\"/>")},
    {"LookAtAlongUp", 3, "lookat", move("<lookat origin=\"0 0 0\" target=\"0 5 0\" up=\"0 1 0\"/>")},
    {"UnknownOperation", 3, "<skew>", move("<skew x=\"1\"/>")},
    {"MeshBeyondRange", 2, "beyond 1e12", move("<scale value=\"2e12\"/>")},
    {"SphereBeyondRange", 3, "beyond 1e12", scene("\n<shape type=\"sphere\"><float name=\"radius\" value=\"2e12\"/></shape>")},
    {"DiskBeyondRange", 3, "beyond 1e12",
     scene("\n<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"2e12\"/></transform></shape>")},
    {"CylinderBeyondRange", 3, "beyond 1e12", scene("\n<shape type=\"cylinder\"><point name=\"p1\" z=\"2e12\"/></shape>")},
    {"InstanceBeyondRange", 4, "instance has a coordinate",
     scene("<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/></shape>\n\n<shape type=\"instance\"><ref id=\"g\"/><transform "
           "name=\"to_world\"><scale value=\"2e12\"/></transform></shape>")},
    {"LightBeyondRange", 3, "light has a coordinate", scene("\n<emitter type=\"point\"><point name=\"position\" y=\"2e12\"/></emitter>")},
    {"TinySphere", 3, "too small", scene("\n<shape type=\"sphere\"><float name=\"radius\" value=\"1e-30\"/></shape>")},
    {"TinyDisk", 3, "too small", scene("\n<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"1e-30\"/></transform></shape>")},
    {"TinyCylinder", 3, "too small", scene("\n<shape type=\"cylinder\"><float name=\"radius\" value=\"1e-30\"/></shape>")},
    {"TinyMesh", 2, "too small", move("<scale value=\"1e-12\"/>")},
    {"OverflowingMesh", 2, "not finite", move("<translate x=\"1e39\"/>")},
    // Plugins and what they refuse
    {"UnknownShape", 2, "shape plugin 'teapot'", scene("<shape type=\"teapot\"/>")},
    {"HeightField", 2, "heightfield' is not supported: convert it to a mesh", scene("<shape type=\"heightfield\"/>")},
    {"Hair", 3, "hair' is not supported: make tubes", scene("\n<shape type=\"hair\"/>")},
    {"Curve", 2, "make tubes of the curves", scene("<shape type=\"bsplinecurve\"/>")},
    {"SignedDistances", 2, "extract the surface", scene("<shape type=\"sdfgrid\"/>")},
    {"ShapeWithoutType", 2, "attribute type", scene("<shape/>")},
    {"UnknownBsdf", 3, "bsdf plugin 'velvet' is not supported; supported are diffuse", bsdf("<bsdf type=\"velvet\"/>")},
    {"Ward", 3, "bsdf plugin 'ward' is not supported: use principled", bsdf("<bsdf type=\"ward\"/>")},
    {"CoatingOfNothing", 3, "bsdf 'coating' needs 1 bsdf inside", bsdf("<bsdf type=\"coating\"/>")},
    {"CoatingOfGlass", 3, "a coating may lie over diffuse, conductor", bsdf("<bsdf type=\"coating\"><bsdf type=\"dielectric\"/></bsdf>")},
    {"CoatingOfACoat", 3, "a roughcoating may lie over diffuse, conductor", bsdf("<bsdf type=\"roughcoating\"><bsdf type=\"plastic\"/></bsdf>")},
    {"CoatingOfNegativeThickness", 3, "thickness of a coating must be >= 0",
     bsdf("<bsdf type=\"coating\"><float name=\"thickness\" value=\"-1\"/><bsdf type=\"diffuse\"/></bsdf>")},
    {"HanrahanKrueger", 3, "'hk' is not supported: use", bsdf("<bsdf type=\"hk\"/>")},
    {"Measured", 3, "'measured' is not supported: use roughconductor", bsdf("<bsdf type=\"measured\"/>")},
    {"PrincipledThin", 3, "'principledthin' is not supported: use thindielectric", bsdf("<bsdf type=\"principledthin\"/>")},
    {"Polarizer", 3, "'polarizer' is not supported: use mask over null", bsdf("<bsdf type=\"polarizer\"/>")},
    {"PrincipledIndexTwice", 4, "either eta or specular",
     bsdf("<bsdf type=\"principled\"><float name=\"eta\" value=\"1.5\"/>\n<float name=\"specular\" value=\"0.5\"/></bsdf>")},
    {"PrincipledBeyondOne", 3, "'metallic' must be between 0 and 1, got 2",
     bsdf("<bsdf type=\"principled\"><float name=\"metallic\" value=\"2\"/></bsdf>")},
    {"PrincipledOfNoIndex", 3, "'specular' must be between 0 and 12",
     bsdf("<bsdf type=\"principled\"><float name=\"specular\" value=\"12.5\"/></bsdf>")},
    {"TwoSidedPrincipledGlass", 3, "transmits",
     bsdf("<bsdf type=\"twosided\"><bsdf type=\"principled\"><float name=\"spec_trans\" value=\"0.1\"/></bsdf></bsdf>")},
    {"NegativeExponent", 3, "'exponent' must be between 0 and 100000",
     bsdf("<bsdf type=\"phong\"><float name=\"exponent\" value=\"-1\"/></bsdf>")},
    {"AshikhminShirley", 3,
     "use beckmann, with alpha =", bsdf("<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"as\"/></bsdf>")},
    {"TexturedPlasticAlpha", 3, "must be a number, not a texture: use principled",
     bsdf("<bsdf type=\"roughplastic\"><texture name=\"alpha\" type=\"checkerboard\"/></bsdf>")},
    {"BrushedPlastic", 3, "give it 'alpha'", bsdf("<bsdf type=\"roughplastic\"><float name=\"alpha_u\" value=\"0.1\"/></bsdf>")},
    {"BumpsWithoutTexture", 3, "needs a <texture>", bsdf("<bsdf type=\"bumpmap\"><bsdf type=\"diffuse\"/></bsdf>")},
    {"NormalsWithoutTexture", 3, "needs a <texture>", bsdf("<bsdf type=\"normalmap\"><bsdf type=\"diffuse\"/></bsdf>")},
    {"TwoSidedBumpyGlass", 3, "transmits",
     bsdf("<bsdf type=\"twosided\"><bsdf type=\"bumpmap\"><texture type=\"checkerboard\" name=\"t\"/><bsdf "
          "type=\"dielectric\"/></bsdf></bsdf>")},
    {"EmptyMixture", 3, "needs bsdfs inside", bsdf("<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"1\"/></bsdf>")},
    {"MixtureWithoutWeights", 3, "weights", bsdf("<bsdf type=\"mixturebsdf\"><bsdf type=\"diffuse\"/></bsdf>")},
    {"MixtureOfFewWeights", 3, "fewer weights",
     bsdf("<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.5\"/><bsdf type=\"diffuse\"/><bsdf type=\"null\"/></bsdf>")},
    {"MixtureOfManyWeights", 3, "more weights",
     bsdf("<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.5, 0.1\"/><bsdf type=\"diffuse\"/></bsdf>")},
    {"MixtureBeyondOne", 3, "more than 1",
     bsdf("<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.7, 0.7\"/><bsdf type=\"diffuse\"/><bsdf "
          "type=\"diffuse\"/></bsdf>")},
    {"TwoBsdfs", 4, "only one <bsdf>", bsdf("<bsdf type=\"diffuse\"/>\n<bsdf type=\"diffuse\"/>")},
    {"UnknownEmitter", 2, "emitter plugin 'laser'", scene("<emitter type=\"laser\"/>")},
    {"DirectionalArea", 3, "emitter plugin 'directionalarea' is not supported: use", bsdf("<emitter type=\"directionalarea\"/>")},
    {"EnvironmentWithoutFile", 2, "filename", scene("<emitter type=\"envmap\"/>")},
    {"EnvironmentFileMissing", 2, "nowhere.exr",
     scene("<emitter type=\"envmap\"><string name=\"filename\" value=\"nowhere.exr\"/></emitter>")},
    {"LooseAreaEmitter", 2, "inside the <shape>", scene("<emitter type=\"area\"/>")},
    {"PointInShape", 3, "only area emitters", bsdf("<emitter type=\"point\"/>")},
    {"Medium", 3, "medium plugin 'homogeneous'", bsdf("<medium name=\"interior\" type=\"homogeneous\"/>")},
    {"UnknownSensor", 1, "sensor plugin 'pinhole' is not supported; supported are perspective", sensor("", "pinhole")},
    {"DistantSensor", 1, "use orthographic", sensor("", "distant")},
    {"RadianceMeter", 1, "film of one pixel", sensor("", "radiancemeter")},
    {"SphericalSensor", 1, "six axes", sensor("", "spherical")},
    {"BatchOfSensors", 1, "scene file of its own", sensor("<sensor type=\"perspective\"/>", "batch")},
    {"ShearedOrthographic", 2, "shear",
     sensor("<transform name=\"to_world\"><rotate z=\"1\" angle=\"30\"/><scale x=\"2\"/></transform>", "orthographic")},
    {"TinyOrthographic", 2, "out of range", sensor("<transform name=\"to_world\"><scale value=\"1e-42\"/></transform>", "orthographic")},
    {"UnknownFilm", 2, "film plugin 'polaroid' is not supported; supported are hdrfilm", sensor("<film type=\"polaroid\"/>")},
    {"SpectralFilm", 2, "use hdrfilm", sensor("<film type=\"specfilm\"/>")},
    {"UnknownFilter", 3, "rfilter plugin 'airy'", film("<rfilter type=\"airy\"/>")},
    {"UnknownMetal", 3, "'Kryptonite'", bsdf("<bsdf type=\"conductor\"><string name=\"material\" value=\"Kryptonite\"/></bsdf>")},
    {"UnknownGlass", 3, "'butter'", bsdf("<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"butter\"/></bsdf>")},
    {"ZeroIor", 3, "> 0", bsdf("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"0\"/></bsdf>")},
    {"NegativeIor", 3, "> 0", bsdf("<bsdf type=\"dielectric\"><float name=\"ext_ior\" value=\"-1.5\"/></bsdf>")},
    {"MaterialAndEta", 3, "not both",
     bsdf("<bsdf type=\"conductor\"><string name=\"material\" value=\"Au\"/><float name=\"eta\" value=\"1\"/></bsdf>")},
    {"EmptyTwoSided", 3, "twosided", bsdf("<bsdf type=\"twosided\"/>")},
    {"TwoSidedGlass", 3, "transmits", bsdf("<bsdf type=\"twosided\"><bsdf type=\"dielectric\"/></bsdf>")},
    {"TwoSidedTwice", 3, "contains itself", bsdf("<bsdf type=\"twosided\" id=\"t\"><ref id=\"t\"/></bsdf>")},
    {"TwoIntegrators", 3, "only one <integrator>", scene("<integrator type=\"path\"/>\n<integrator type=\"sppm\"/>")},
    // Ranges
    {"ZeroWidth", 3, "between 1 and 65536", film("<integer name=\"width\" value=\"0\"/>")},
    {"NegativeHeight", 3, "between 1 and 65536", film("<integer name=\"height\" value=\"-4\"/>")},
    {"WideFilm", 3, "65536", film("<integer name=\"width\" value=\"65537\"/>")},
    {"LargeFilm", 3, "2^28", film("<integer name=\"width\" value=\"20000\"/><integer name=\"height\" value=\"20000\"/>")},
    {"CropOutside", 3, "outside", film("<integer name=\"crop_offset_x\" value=\"700\"/><integer name=\"crop_width\" value=\"100\"/>")},
    {"CropBeyondIntegers", 3, "outside",
     film("<integer name=\"crop_offset_y\" value=\"2147483647\"/><integer name=\"crop_height\" value=\"2147483647\"/>")},
    {"EmptyCrop", 3, "crop_height", film("<integer name=\"crop_height\" value=\"0\"/>")},
    {"NegativeCrop", 3, "crop_offset_x", film("<integer name=\"crop_offset_x\" value=\"-1\"/>")},
    {"ZeroFov", 2, "(0, 180)", sensor("<float name=\"fov\" value=\"0\"/>")},
    {"TinyFov", 2, "at least 1e-5 degrees", sensor("<float name=\"fov\" value=\"1e-30\"/>")},
    {"LongLens", 2, "too narrow", sensor("<string name=\"focal_length\" value=\"1e30mm\"/>")},
    {"NearlyStraightFov", 2, "at most 179.99999 degrees", sensor("<float name=\"fov\" value=\"179.99999999\"/>")},
    {"FarSensor", 2, "beyond 1e12", sensor("<transform name=\"to_world\"><translate x=\"1e13\"/></transform>")},
    {"FarPoint", 2, "beyond 1e12", scene("<emitter type=\"point\"><point name=\"position\" x=\"1e30\"/></emitter>")},
    {"BlindingLight", 2, "at most 1e18, got 3e+38", scene("<emitter type=\"constant\"><rgb name=\"radiance\" value=\"3e38\"/></emitter>")},
    {"TinyIor", 3, "between 0.01 and 100, got 1e-30", bsdf("<bsdf type=\"plastic\"><float name=\"int_ior\" value=\"1e-30\"/><float name=\"ext_ior\" value=\"1\"/></bsdf>")},
    {"HugeIor", 3, "between 0.01 and 100", bsdf("<bsdf type=\"roughdielectric\"><float name=\"int_ior\" value=\"1e30\"/></bsdf>")},
    {"HugePrincipledIor", 3, "between 0.01 and 100", bsdf("<bsdf type=\"principled\"><float name=\"eta\" value=\"1e30\"/></bsdf>")},
    {"HugeEta", 3, "at most 1e8", bsdf("<bsdf type=\"conductor\"><float name=\"eta\" value=\"1e30\"/></bsdf>")},
    {"TinyFilter", 3, "between 0.001 and 32 pixels", film("<rfilter type=\"gaussian\"><float name=\"stddev\" value=\"1e-30\"/></rfilter>")},
    {"SteepBumps", 3, "must be between -1e+09 and 1e+09",
     bsdf("<bsdf type=\"bumpmap\"><float name=\"scale\" value=\"1e30\"/><texture type=\"checkerboard\" name=\"t\"/><bsdf type=\"diffuse\"/></bsdf>")},
    {"UnknownEncoding", 1, "encoding 'KLINGON-8'", "<?xml version=\"1.0\" encoding=\"KLINGON-8\"?><scene version=\"3.0.0\"/>"},
    {"BrokenEncoding", 1, "not in the encoding 'UTF-16LE'", std::string("\xff\xfe<\0\x00\xd8", 6)},
    {"StraightFov", 2, "(0, 180)", sensor("<float name=\"fov\" value=\"180\"/>")},
    {"FovAxis", 2, "fov_axis", sensor("<float name=\"fov\" value=\"30\"/><string name=\"fov_axis\" value=\"z\"/>")},
    {"FovAndFocalLength", 2, "not both", sensor("<float name=\"fov\" value=\"30\"/><string name=\"focal_length\" value=\"50mm\"/>")},
    {"FocalLength", 2, "50mm", sensor("<string name=\"focal_length\" value=\"2in\"/>")},
    {"ClipsSwapped", 2, "near_clip", sensor("<float name=\"near_clip\" value=\"5\"/><float name=\"far_clip\" value=\"2\"/>")},
    {"ShearedCamera", 2, "shear", sensor("<transform name=\"to_world\"><scale x=\"2\"/></transform>")},
    {"LensWithoutRadius", 1, "aperture_radius", sensor("", "thinlens")},
    {"SampleCount", 2, "sample_count", sensor("<sampler type=\"independent\"><integer name=\"sample_count\" value=\"0\"/></sampler>")},
    {"NegativeRadius", 3, "> 0", bsdf("<float name=\"radius\" value=\"-1\"/>")},
    {"Ellipsoid", 3, "evenly", bsdf("<transform name=\"to_world\"><scale x=\"2\"/></transform>")},
    {"NegativeRadiance", 3, "negative", bsdf("<emitter type=\"area\"><rgb name=\"radiance\" value=\"1 -1 1\"/></emitter>")},
    {"NanRadiance", 3, "finite", bsdf("<emitter type=\"area\"><rgb name=\"radiance\" value=\"nan\"/></emitter>")},
    {"SpotAngles", 2, "beam_width", scene("<emitter type=\"spot\"><float name=\"beam_width\" value=\"40\"/></emitter>")},
    {"LanczosWithoutLobes", 3, "at least one lobe", film("<rfilter type=\"lanczos\"><integer name=\"lobes\" value=\"0\"/></rfilter>")},
    {"ZeroDirection", 2, "direction", scene("<emitter type=\"directional\"><vector name=\"direction\" value=\"0\"/></emitter>")},
    {"TwoEnvironments", 3, "two environments", scene("<emitter type=\"constant\"/>\n<emitter type=\"constant\"/>")},
    {"TinyLight", 2, "too small",
     scene("<shape type=\"disk\"><transform name=\"to_world\"><scale value=\"1e-30\"/></transform><emitter type=\"area\"/></shape>")},
    {"LightTooBright", 2, "'intensity' must be at most 1e18", scene("<emitter type=\"point\"><rgb name=\"intensity\" value=\"1e38\"/></emitter>")},
    {"LampTooBright", 2, "'radiance' must be at most 1e18",
     scene("<shape type=\"sphere\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"1e38\"/></emitter></shape>")},
    // The scene as a whole
    {"NoSensor", 0, "<sensor>", "<scene version=\"3.0.0\">" + light + "</scene>"},
    {"NoLight", 0, "no light", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"cube\"/></scene>"},
    {"DarkLight", 1, "no light: this one emits nothing",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"cube\"><emitter type=\"area\"><rgb name=\"radiance\" "
     "value=\"0\"/></emitter></shape></scene>"},
    {"CylinderWithoutLength", 2, "two different end points", scene("<shape type=\"cylinder\"><point name=\"p1\" x=\"0\"/></shape>")},
    {"EllipticCylinder", 3, "scale evenly across the axis",
     scene("<shape type=\"cylinder\">\n<transform name=\"to_world\"><scale x=\"2\"/></transform></shape>")},
    {"ObliqueCylinder", 3, "use a mesh",
     scene("<shape type=\"cylinder\">\n<transform name=\"to_world\"><matrix value=\"1 0 1 0 0 1 0 0 0 0 1 0 0 0 0 "
           "1\"/></transform></shape>")},
    {"CylinderRadius", 2, "'radius'", scene("<shape type=\"cylinder\"><float name=\"radius\" value=\"0\"/></shape>")},
    // Meshes
    {"MissingMesh", 3, "tried", scene("<shape type=\"obj\">\n<string name=\"filename\" value=\"nowhere.obj\"/></shape>")},
    {"MeshWithoutName", 2, "filename", scene("<shape type=\"ply\"/>")},
};

class BrokenScene : public ::testing::TestWithParam<Broken>
{
};

TEST_P(BrokenScene, IsASceneErrorAtItsLine)
{
    const SceneFolder folder;
    const Broken& broken = GetParam();
    try {
        folder.load(broken.xml);
        FAIL() << "loaded";
    } catch (const SceneError& error) {
        EXPECT_EQ(error.status(), ExitStatus::scene);
        const std::string place = "scene.xml:" + (broken.line > 0 ? std::to_string(broken.line) + ":" : "");
        EXPECT_THAT(error.what(), HasSubstr(place + " "));
        EXPECT_THAT(error.what(), HasSubstr(broken.word));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    }
}

INSTANTIATE_TEST_SUITE_P(Import, BrokenScene, ::testing::ValuesIn(broken_scenes),
                         [](const ::testing::TestParamInfo<Broken>& parameter) { return parameter.param.name; });

struct BrokenFile {
    const char* name;
    const char* file;
    const char* place; // file and line in the message
    const char* word;
    std::string content;
};

void PrintTo(const BrokenFile& broken, std::ostream* out)
{
    *out << broken.name;
}

const std::string ply_vertices = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string ply_faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

const std::vector<BrokenFile> broken_files = {
    {"ObjIndexTooLarge", "m.obj", "m.obj:4:", "face 1 refers to vertex 9", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
    {"ObjIndexZero", "m.obj", "m.obj:4:", "vertex 0", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"},
    {"ObjIndexTooNegative", "m.obj", "m.obj:4:", "vertex -4", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"},
    {"ObjIndexNotANumber", "m.obj", "m.obj:4:", "'x'", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n"},
    {"ObjNormalIndex", "m.obj", "m.obj:5:", "normal 2", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//2\n"},
    {"ObjNanVertex", "m.obj", "m.obj:2:", "vertex 2", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"ObjInfiniteVertex", "m.obj", "m.obj:1:", "vertex 1", "v 0 1e39 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"ObjShortVertex", "m.obj", "m.obj:3:", "vertex 3", "v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n"},
    {"ObjNanNormal", "m.obj", "m.obj:1:", "normal 1", "vn nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n"},
    {"ObjEdge", "m.obj", "m.obj:", "no faces of three vertices or more", "v 0 0 0\nv 1 0 0\nf 1 2\n"},
    {"ObjEmpty", "m.obj", "m.obj:", "no faces", ""},
    {"ObjOnlyDegenerate", "m.obj", "scene.xml:2:", "no triangles", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"},
    {"IncludedSyntax", "m.xml", "m.xml:2:", "truncated", "<scene version=\"3.0.0\">\n<shape"},
    {"IncludedValue", "m.xml", "m.xml:3:", "'wide'",
     "<scene version=\"3.0.0\">\n<shape type=\"sphere\">\n<float name=\"radius\" value=\"wide\"/></shape></scene>"},
    {"IncludeCycle", "m.xml", "m.xml:1:", "cyclic <include>: scene.xml includes m.xml includes scene.xml",
     "<include filename=\"scene.xml\"/>"},
    {"PlyNotPly", "m.ply", "m.ply:1:", "not a PLY file", "solid stl\n"},
    {"PlyEmpty", "m.ply", "m.ply:1:", "truncated", ""},
    {"PlyFormat", "m.ply", "m.ply:2:", "format 'morse'", "ply\nformat morse 1.0\n"},
    {"PlyWithoutFaces", "m.ply", "m.ply:", "no faces", ply_vertices + "end_header\n0 0 0\n1 0 0\n0 1 0\n"},
    {"PlyIndex", "m.ply", "m.ply:13:", "refers to vertex 3", ply_vertices + ply_faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"},
    {"PlyNan", "m.ply", "m.ply:", "vertex 3 is not finite", ply_vertices + ply_faces + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n"},
    {"PlyTruncated", "m.ply", "m.ply:12:", "ends early", ply_vertices + ply_faces + "0 0 0\n1 0 0\n0 1 0\n"},
    {"PlyHugeCount", "m.ply", "m.ply:3:", "2^31", "ply\nformat ascii 1.0\nelement vertex 99999999999\n"},
    {"PlyNegativeList", "m.ply", "m.ply:13:", "list of -3",
     ply_vertices + "element face 1\nproperty list char int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"},
};

class BrokenSceneFile : public ::testing::TestWithParam<BrokenFile>
{
};

TEST_P(BrokenSceneFile, IsASceneErrorThere)
{
    const SceneFolder folder;
    const BrokenFile& broken = GetParam();
    folder.write(broken.file, broken.content);
    const std::string extension = std::string(broken.file).substr(2);
    const std::string use = extension == "xml"
                                ? "<include filename=\"m.xml\"/>"
                                : "<shape type=\"" + extension + "\"><string name=\"filename\" value=\"" + broken.file + "\"/></shape>";
    try {
        folder.load(scene(use));
        FAIL() << "loaded";
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::string("/") + broken.place + " "));
        EXPECT_THAT(error.what(), HasSubstr(broken.word));
    }
}

INSTANTIATE_TEST_SUITE_P(Import, BrokenSceneFile, ::testing::ValuesIn(broken_files),
                         [](const ::testing::TestParamInfo<BrokenFile>& parameter) { return parameter.param.name; });

TEST(ImportErrors, MissingSceneIsASceneErrorWithThePath)
{
    try {
        load_scene("no/such/scene.xml", {});
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no/such/scene.xml"));
        EXPECT_THAT(error.what(), HasSubstr("not found"));
    }
    const SceneFolder folder;
    EXPECT_THROW(load_scene(folder.path(), {}), SceneError) << "a folder";
}

TEST(ImportErrors, MissingMeshNamesEveryPathTried)
{
    const SceneFolder folder;
    folder.write("meshes/readme", "");
    try {
        folder.load(scene("<path value=\"meshes\"/><shape type=\"obj\"><string name=\"filename\" value=\"ball.obj\"/></shape>"));
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr((folder.path() / "meshes/ball.obj").string()));
        EXPECT_THAT(error.what(), HasSubstr((folder.path() / "ball.obj").string()));
    }
}

TEST(ImportErrors, IncludesThatMultiplyAreCutOff)
{
    const SceneFolder folder;
    for (int level = 0; level < 12; level++) {
        std::string xml = "<scene version=\"3.0.0\">";
        for (int i = 0; i < 10; i++)
            xml += level == 11 ? "<bsdf type=\"null\"/>" : "<include filename=\"" + std::to_string(level + 1) + ".xml\"/>";
        folder.write(std::to_string(level) + ".xml", xml + "</scene>");
    }
    EXPECT_THROW(folder.load(scene("<include filename=\"0.xml\"/>")), SceneError);
}

} // namespace
