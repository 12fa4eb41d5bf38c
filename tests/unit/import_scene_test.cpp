#include "unit/scene_folder.h"

#include <gmock/gmock.h>

namespace
{

using namespace sundog;
using sundog::testing::expect_near;
using sundog::testing::load_with;
using sundog::testing::SceneFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

template <typename Model> const Model& bsdf_of(const LoadedScene& loaded, std::size_t shape)
{
    return std::get<Model>(loaded.scene.bsdfs.at(loaded.scene.shapes.at(shape).bsdf).model);
}

// The whole scene but for places, as text.
std::string fingerprint(const Scene& scene)
{
    std::ostringstream out;
    const auto put = [&](Vec3 v) { out << v.x << ' ' << v.y << ' ' << v.z << '\n'; };
    const Sensor& s = scene.sensor;
    for (Vec3 v : {s.position, s.axis_x, s.axis_y, s.axis_z}) put(v);
    out << s.fov_x << ' ' << s.near_clip << ' ' << s.far_clip << ' ' << s.aperture_radius << ' ' << s.focus_distance << '\n';
    const Film& f = scene.film;
    for (int v : {f.width, f.height, f.crop_x, f.crop_y, f.crop_width, f.crop_height}) out << v << ' ';
    out << static_cast<int>(f.filter.kind) << ' ' << f.filter.radius << '\n';
    out << scene.integrator.method << ' ' << scene.integrator.sample_count << '\n';
    for (const auto& [name, value] : scene.integrator.parameters) out << name << '=' << value.value << '\n';
    for (const auto& bsdf : scene.bsdfs) {
        out << bsdf.id << ' ' << bsdf.model.index() << '\n';
        if (const auto* diffuse = std::get_if<DiffuseBsdf>(&bsdf.model)) put(diffuse->reflectance.value);
        if (const auto* glass = std::get_if<DielectricBsdf>(&bsdf.model)) out << glass->int_ior << ' ' << glass->ext_ior << '\n';
        if (const auto* metal = std::get_if<ConductorBsdf>(&bsdf.model)) put(metal->eta), put(metal->k);
    }
    for (const auto& shape : scene.shapes) {
        out << shape.id << ' ' << shape.bsdf << ' ' << shape.geometry.index() << '\n';
        if (shape.emitter) put(shape.emitter->radiance);
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
            for (Vec3 p : mesh->positions) put(p);
            for (const auto& t : mesh->triangles) out << t[0] << t[1] << t[2] << '\n';
        }
        if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) put(sphere->center), out << sphere->radius << sphere->flip_normals;
    }
    for (const auto& emitter : scene.emitters) {
        out << emitter.model.index() << '\n';
        if (const auto* spot = std::get_if<SpotEmitter>(&emitter.model))
            put(spot->direction), out << spot->cutoff_angle << spot->beam_width;
    }
    return out.str();
}

constexpr const char* new_schema = R"(<scene version="3.5.0">
  <integrator type="sppm"><integer name="max_depth" value="7"/><integer name="rr_depth" value="3"/></integrator>
  <sensor type="thinlens">
    <float name="fov" value="40"/><string name="fov_axis" value="y"/>
    <float name="near_clip" value="0.1"/><float name="far_clip" value="100"/>
    <float name="aperture_radius" value="0.05"/><float name="focus_distance" value="4"/>
    <transform name="to_world"><lookat origin="0, 1, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm">
      <integer name="width" value="320"/><integer name="height" value="200"/>
      <integer name="crop_offset_x" value="10"/><integer name="crop_offset_y" value="20"/>
      <integer name="crop_width" value="100"/><integer name="crop_height" value="50"/>
      <rfilter type="tent"/>
    </film>
    <sampler type="independent"><integer name="sample_count" value="9"/></sampler>
  </sensor>
  <bsdf type="diffuse" id="white"><rgb name="reflectance" value="0.8"/></bsdf>
  <shape type="sphere" id="ball"><point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>
    <boolean name="flip_normals" value="true"/>
    <bsdf type="dielectric"><string name="int_ior" value="water"/><float name="ext_ior" value="1"/></bsdf></shape>
  <shape type="rectangle"><transform name="to_world"><scale value="2"/><rotate x="1" angle="90"/></transform><ref id="white"/></shape>
  <shape type="cube"><bsdf type="conductor"><string name="material" value="Au"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter></shape>
  <emitter type="spot"><float name="cutoff_angle" value="30"/><float name="beam_width" value="10"/></emitter>
</scene>)";

constexpr const char* old_schema = R"(<scene version="0.6.0">
  <integrator type="sppm"><integer name="maxDepth" value="7"/><integer name="rrDepth" value="3"/></integrator>
  <sensor type="thinlens">
    <float name="fov" value="40"/><string name="fovAxis" value="y"/>
    <float name="nearClip" value="0.1"/><float name="farClip" value="100"/>
    <float name="apertureRadius" value="0.05"/><float name="focusDistance" value="4"/>
    <transform name="toWorld"><lookAt origin="0, 1, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm">
      <integer name="width" value="320"/><integer name="height" value="200"/>
      <integer name="cropOffsetX" value="10"/><integer name="cropOffsetY" value="20"/>
      <integer name="cropWidth" value="100"/><integer name="cropHeight" value="50"/>
      <rfilter type="tent"/>
    </film>
    <sampler type="independent"><integer name="sampleCount" value="9"/></sampler>
  </sensor>
  <bsdf type="diffuse" id="white"><spectrum name="diffuseReflectance" value="0.8"/></bsdf>
  <shape type="sphere" id="ball"><point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>
    <boolean name="flipNormals" value="true"/>
    <bsdf type="dielectric"><string name="intIOR" value="water"/><float name="extIOR" value="1"/></bsdf></shape>
  <shape type="rectangle"><transform name="toWorld"><scale value="2"/><rotate x="1" angle="90"/></transform><ref id="white"/></shape>
  <shape type="cube"><bsdf type="conductor"><string name="material" value="Au"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="1 2 3"/></emitter></shape>
  <emitter type="spot"><float name="cutoffAngle" value="30"/><float name="beamWidth" value="10"/></emitter>
</scene>)";

TEST(ImportScene, BothSchemasGiveTheSameScene)
{
    const SceneFolder folder;
    const LoadedScene a = folder.load(new_schema), b = folder.load(old_schema);
    EXPECT_THAT(a.warnings, IsEmpty());
    EXPECT_THAT(b.warnings, IsEmpty());
    EXPECT_EQ(fingerprint(a.scene), fingerprint(b.scene));

    // And it is the right one.
    const Scene& scene = a.scene;
    EXPECT_EQ(scene.integrator.method, "sppm");
    EXPECT_EQ(scene.integrator.parameters.at("max_depth").value, "7");
    EXPECT_EQ(scene.integrator.parameters.at("max_depth").where.line, 2);
    EXPECT_EQ(scene.integrator.sample_count, 9);
    EXPECT_EQ(scene.film.crop_width, 100);
    EXPECT_EQ(scene.film.filter.kind, FilterKind::tent);
    EXPECT_FLOAT_EQ(scene.film.filter.radius, 1.0f);
    EXPECT_NEAR(std::tan(scene.sensor.fov_x / 2), std::tan(20.0 * 3.14159265 / 180) * 1.6, 1e-6);
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_TRUE(std::get<Sphere>(scene.shapes[0].geometry).flip_normals);
    EXPECT_FLOAT_EQ(bsdf_of<DielectricBsdf>(a, 0).int_ior, 1.333f);
    expect_near(bsdf_of<DiffuseBsdf>(a, 1).reflectance.value, {0.8f, 0.8f, 0.8f}, 0);
    EXPECT_EQ(scene.bsdfs[scene.shapes[1].bsdf].id, "white");
    expect_near(scene.shapes[2].emitter->radiance, {1, 2, 3}, 0);
    EXPECT_NEAR(std::get<SpotEmitter>(scene.emitters.at(0).model).beam_width, 10 * 3.14159265 / 180, 1e-6);
}

TEST(ImportScene, TransformsApplyInDocumentOrder)
{
    const auto loaded = load_with(R"(<shape type="sphere"><transform name="to_world">
        <translate x="1"/><scale value="2"/><rotate z="1" angle="90"/><translate value="0, 0, 3"/></transform></shape>)");
    const auto& sphere = std::get<Sphere>(loaded.scene.shapes.at(0).geometry);
    expect_near(sphere.center, {0, 2, 3}, 1e-6f);
    EXPECT_FLOAT_EQ(sphere.radius, 2.0f);
    const auto matrices = load_with(R"(<shape type="sphere"><transform name="to_world">
        <matrix value="0 -1 0  1 0 0  0 0 1"/><matrix value="1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1"/></transform>
        <point name="center" x="1"/></shape>)");
    expect_near(std::get<Sphere>(matrices.scene.shapes.at(0).geometry).center, {5, 7, 7}, 1e-6f);
}

TEST(ImportScene, DefaultsAndDefines)
{
    const std::string xml = R"(<default name="r" value="0.25"/><default name="radius" value="3"/>
        <shape type="sphere"><float name="radius" value="$radius"/><bsdf type="diffuse"><rgb name="reflectance" value="$r $r 0.5"/></bsdf></shape>)";
    const auto plain = load_with(xml);
    EXPECT_FLOAT_EQ(std::get<Sphere>(plain.scene.shapes.at(0).geometry).radius, 3.0f);
    expect_near(bsdf_of<DiffuseBsdf>(plain, 0).reflectance.value, {0.25f, 0.25f, 0.5f}, 0);
    const auto defined = load_with(xml, {{{"r", "0.75"}}});
    expect_near(bsdf_of<DiffuseBsdf>(defined, 0).reflectance.value, {0.75f, 0.75f, 0.5f}, 0);
    // Without a <default>, too.
    const auto bare = load_with(R"(<shape type="sphere"><float name="radius" value="$size"/></shape>)", {{{"size", "7"}}});
    EXPECT_FLOAT_EQ(std::get<Sphere>(bare.scene.shapes.at(0).geometry).radius, 7.0f);
    try {
        load_with(xml, {{{"radios", "1"}}});
        FAIL() << "an unknown define must be refused";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), HasSubstr("radios"));
        EXPECT_THAT(error.what(), HasSubstr("r, radius"));
    }
}

TEST(ImportScene, IncludesShareParametersAndKeepTheirLines)
{
    const SceneFolder folder;
    folder.write("parts/ball.xml",
                 "<scene version=\"3.0.0\">\n\n<shape type=\"sphere\" id=\"ball\">\n<float name=\"radius\" value=\"$size\"/>\n"
                 "<float name=\"wobble\" value=\"1\"/>\n<ref id=\"paint\"/></shape></scene>");
    folder.write("parts/paint.xml", "<bsdf type=\"diffuse\" id=\"paint\"/>");
    const auto loaded = folder.load(sundog::testing::scene_with("<default name=\"size\" value=\"2\"/><include filename=\"parts/ball.xml\"/>"
                                                                "<path value=\"parts\"/><include filename=\"paint.xml\"/>"));
    EXPECT_FLOAT_EQ(std::get<Sphere>(loaded.scene.shapes.at(0).geometry).radius, 2.0f);
    EXPECT_EQ(loaded.scene.shapes[0].where.file, (folder.path() / "parts/ball.xml").string());
    EXPECT_EQ(loaded.scene.shapes[0].where.line, 3);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("ball.xml:5: parameter 'wobble' of shape 'sphere'")));
}

TEST(ImportScene, ReferencesMayLookForwardAndThroughAliases)
{
    const auto loaded = load_with(R"(<shape type="sphere"><ref id="paint"/></shape><shape type="disk"><ref id="lacquer"/></shape>
        <bsdf type="diffuse" id="paint"><rgb name="reflectance" value="0.1, 0.2, 0.3"/></bsdf><alias id="paint" as="lacquer"/>)");
    EXPECT_EQ(loaded.scene.shapes.at(0).bsdf, loaded.scene.shapes.at(1).bsdf) << "one object, used twice";
    expect_near(bsdf_of<DiffuseBsdf>(loaded, 0).reflectance.value, {0.1f, 0.2f, 0.3f}, 1e-7f);
}

TEST(ImportScene, PlasticAndItsDefaults)
{
    const auto loaded = load_with(R"(<shape type="sphere"><bsdf type="plastic"/></shape>
        <shape type="sphere"><bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.25"/>
        <boolean name="nonlinear" value="true"/><rgb name="diffuse_reflectance" value="0.1, 0.2, 0.3"/><float name="int_ior" value="1.8"/></bsdf></shape>)");
    const auto& smooth = bsdf_of<PlasticBsdf>(loaded, 0);
    EXPECT_FLOAT_EQ(smooth.int_ior, 1.49f);
    EXPECT_FALSE(smooth.nonlinear || smooth.roughness);
    expect_near(smooth.diffuse_reflectance.value, {0.5f, 0.5f, 0.5f}, 0);
    const auto& rough = bsdf_of<PlasticBsdf>(loaded, 1);
    ASSERT_TRUE(rough.roughness);
    EXPECT_FALSE(rough.roughness->beckmann);
    EXPECT_FLOAT_EQ(rough.roughness->alpha_v.value, 0.25f);
    EXPECT_TRUE(rough.nonlinear);
    EXPECT_FLOAT_EQ(rough.int_ior, 1.8f);
}

TEST(ImportScene, PrincipledAndItsDefaults)
{
    const auto loaded = load_with(R"(<shape type="sphere"><bsdf type="principled"/></shape>
        <shape type="sphere"><bsdf type="principled"><rgb name="base_color" value="0.1, 0.2, 0.3"/><float name="specular" value="0.8"/>
        <float name="clearcoat_gloss" value="0.6"/><texture type="checkerboard" name="metallic"/></bsdf></shape>
        <shape type="sphere"><bsdf type="principled"><float name="eta" value="1"/><float name="spec_trans" value="0.5"/></bsdf></shape>)");
    const auto& plain = bsdf_of<PrincipledBsdf>(loaded, 0);
    expect_near(plain.base_color.value, {0.5f, 0.5f, 0.5f}, 0);
    EXPECT_FLOAT_EQ(plain.roughness.value, 0.5f);
    EXPECT_FLOAT_EQ(plain.eta, 1.5f) << "of specular 0.5";
    for (const NumberSource& number : {plain.anisotropic, plain.metallic, plain.spec_trans, plain.spec_tint, plain.sheen, plain.sheen_tint,
                                       plain.flatness, plain.clearcoat, plain.clearcoat_gloss})
        EXPECT_EQ(number.value, 0.0f);
    EXPECT_FALSE(plain.transmits());
    const auto& set = bsdf_of<PrincipledBsdf>(loaded, 1);
    expect_near(set.base_color.value, {0.1f, 0.2f, 0.3f}, 1e-7f);
    EXPECT_NEAR(std::pow((set.eta - 1.0f) / (set.eta + 1.0f), 2.0f), 0.08f * 0.8f, 1e-6f);
    EXPECT_FLOAT_EQ(set.clearcoat_gloss.value, 0.6f);
    EXPECT_TRUE(set.metallic.texture);
    EXPECT_FLOAT_EQ(bsdf_of<PrincipledBsdf>(loaded, 2).eta, 1.001f) << "glass has an interface";
    EXPECT_TRUE(bsdf_of<PrincipledBsdf>(loaded, 2).transmits());
}

TEST(ImportScene, PhongReflectsNoMoreThanItGets)
{
    const auto loaded = load_with(R"(<shape type="sphere"><bsdf type="phong"/></shape><shape type="sphere"><bsdf type="phong">
        <rgb name="diffuse_reflectance" value="0.2, 0.6, 0.2"/><rgb name="specular_reflectance" value="0.1, 0.6, 0.3"/>
        <float name="exponent" value="7"/></bsdf></shape>)");
    const auto& plain = bsdf_of<PhongBsdf>(loaded, 0);
    expect_near(plain.diffuse_reflectance.value, {0.5f, 0.5f, 0.5f}, 0);
    expect_near(plain.specular_reflectance.value, {0.2f, 0.2f, 0.2f}, 0);
    EXPECT_EQ(plain.exponent.value, 30.0f);
    const auto& scaled = bsdf_of<PhongBsdf>(loaded, 1);
    expect_near(scaled.diffuse_reflectance.value, {0.165f, 0.495f, 0.165f}, 1e-6f);
    expect_near(scaled.specular_reflectance.value, {0.0825f, 0.495f, 0.2475f}, 1e-6f);
    EXPECT_EQ(scaled.exponent.value, 7.0f);
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_THAT(loaded.warnings[0], ::testing::HasSubstr("add up to more than 1"));
}

// Probabilities along the tree of blends are the weights, and black takes what is left of 1.
double weight_in(const Scene& scene, uint bsdf, float red)
{
    if (const auto* blend = std::get_if<BlendBsdf>(&scene.bsdfs[bsdf].model)) {
        const double second = static_cast<double>(blend->weight.value);
        return (1.0 - second) * weight_in(scene, blend->nested[0], red) + second * weight_in(scene, blend->nested[1], red);
    }
    return std::get<DiffuseBsdf>(scene.bsdfs[bsdf].model).reflectance.value.x == red ? 1.0 : 0.0;
}

TEST(ImportScene, MixturesBecomeBlends)
{
    std::string parts;
    for (const char* red : {"0.25", "0.5", "0.75"})
        parts += std::string("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"") + red + ", 0, 0\"/></bsdf>";
    const auto loaded = load_with("<shape type=\"sphere\"><bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.1, 0.3, 0.4\"/>" +
                                  parts + "</bsdf></shape>");
    const uint mixture = loaded.scene.shapes.at(0).bsdf;
    EXPECT_NEAR(weight_in(loaded.scene, mixture, 0.25f), 0.1, 1e-6);
    EXPECT_NEAR(weight_in(loaded.scene, mixture, 0.5f), 0.3, 1e-6);
    EXPECT_NEAR(weight_in(loaded.scene, mixture, 0.75f), 0.4, 1e-6);
    EXPECT_NEAR(weight_in(loaded.scene, mixture, 0.0f), 0.2, 1e-6);
}

TEST(ImportScene, ReliefHoldsOneBsdfAndOneTexture)
{
    const std::string texture = R"(<texture type="checkerboard" name="any"/>)", inside = R"(<bsdf type="diffuse"/>)";
    const auto loaded = load_with(
        "<shape type=\"sphere\"><bsdf type=\"bumpmap\"><float name=\"scale\" value=\"3\"/>" + texture + inside +
        "</bsdf></shape><shape type=\"sphere\"><bsdf type=\"normalmap\"><boolean name=\"flip_invalid_normals\" value=\"false\"/>" +
        texture + inside + "</bsdf></shape>");
    const auto& bumps = bsdf_of<BumpMapBsdf>(loaded, 0);
    EXPECT_FLOAT_EQ(bumps.heights.value, 3.0f);
    EXPECT_TRUE(bumps.heights.texture.has_value());
    EXPECT_TRUE(bumps.flip_invalid && bumps.shadowing);
    const auto& normals = bsdf_of<NormalMapBsdf>(loaded, 1);
    EXPECT_TRUE(normals.normals.texture.has_value());
    EXPECT_FALSE(normals.flip_invalid);
    EXPECT_TRUE(normals.shadowing);
}

TEST(ImportScene, UnusedObjectsOfUnsupportedTypesAreNoFault)
{
    const auto loaded = load_with(R"(<bsdf type="irawan" id="unused"/><texture type="bitmap" id="t"/><medium type="homogeneous" id="m"/>)");
    EXPECT_EQ(loaded.scene.bsdfs.size(), 1u);
}

TEST(ImportScene, BsdfsOfEveryKind)
{
    const auto loaded = load_with(R"(
        <shape type="sphere"><bsdf type="dielectric"/></shape>
        <shape type="sphere"><bsdf type="thindielectric"><float name="int_ior" value="1.3"/></bsdf></shape>
        <shape type="sphere"><bsdf type="conductor"/></shape>
        <shape type="sphere"><bsdf type="conductor"><rgb name="eta" value="1 2 3"/><spectrum name="k" value="4"/></bsdf></shape>
        <shape type="sphere"><bsdf type="null"/></shape>
        <shape type="sphere"><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
        <shape type="sphere"><bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="conductor"/></bsdf></shape>
        <shape type="sphere"/><shape type="sphere"><emitter type="area"/></shape>)");
    const auto& glass = bsdf_of<DielectricBsdf>(loaded, 0);
    EXPECT_FLOAT_EQ(glass.int_ior, 1.5046f);
    EXPECT_FLOAT_EQ(glass.ext_ior, 1.000277f);
    EXPECT_FALSE(glass.thin);
    EXPECT_TRUE(bsdf_of<DielectricBsdf>(loaded, 1).thin);
    expect_near(bsdf_of<ConductorBsdf>(loaded, 2).eta, {0, 0, 0}, 0);
    expect_near(bsdf_of<ConductorBsdf>(loaded, 2).k, {1, 1, 1}, 0);
    expect_near(bsdf_of<ConductorBsdf>(loaded, 3).eta, {1, 2, 3}, 0);
    expect_near(bsdf_of<ConductorBsdf>(loaded, 3).k, {4, 4, 4}, 0);
    bsdf_of<NullBsdf>(loaded, 4);
    const auto& one = bsdf_of<TwoSidedBsdf>(loaded, 5);
    EXPECT_EQ(one.front, one.back);
    const auto& two = bsdf_of<TwoSidedBsdf>(loaded, 6);
    EXPECT_TRUE(std::holds_alternative<DiffuseBsdf>(loaded.scene.bsdfs[two.front].model));
    EXPECT_TRUE(std::holds_alternative<ConductorBsdf>(loaded.scene.bsdfs[two.back].model));
    expect_near(bsdf_of<DiffuseBsdf>(loaded, 7).reflectance.value, {0.5f, 0.5f, 0.5f}, 0);
    expect_near(bsdf_of<DiffuseBsdf>(loaded, 8).reflectance.value, {0, 0, 0}, 0);
    // Mitsuba 0.6 makes a conductor of copper.
    const auto old = load_with(R"(<shape type="sphere"><bsdf type="conductor"/></shape>)", {}, "0.5.0");
    EXPECT_GT(bsdf_of<ConductorBsdf>(old, 0).k.x, 3.0f);
}

TEST(ImportScene, EmittersOfEveryKind)
{
    const auto loaded = load_with(R"(
        <emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="#ff0080"/></emitter>
        <emitter type="spot"><transform name="to_world"><lookat origin="0 0 0" target="0 -3 0" up="1 0 0"/></transform></emitter>
        <emitter type="directional"><vector name="direction" x="0" y="-2" z="0"/><spectrum name="irradiance" value="3"/></emitter>
        <emitter type="constant"><srgb name="radiance" value="0.5 0.5 0.5"/></emitter>
        <emitter type="point"><spectrum type="blackbody" name="intensity"><float name="temperature" value="5000"/>
            <float name="scale" value="2"/></spectrum></emitter>
        <emitter type="point"><blackbody name="intensity" temperature="5000K" scale="2"/></emitter>)");
    const auto& emitters = loaded.scene.emitters;
    ASSERT_EQ(emitters.size(), 6u);
    const auto& point = std::get<PointEmitter>(emitters[0].model);
    EXPECT_EQ(point.position, (Vec3{1, 2, 3}));
    expect_near(point.intensity, {1, 0, 128.0f / 255}, 1e-6f);
    const auto& spot = std::get<SpotEmitter>(emitters[1].model);
    expect_near(spot.direction, {0, -1, 0}, 1e-7f);
    EXPECT_NEAR(spot.cutoff_angle, 0.349066f, 1e-6f);
    EXPECT_NEAR(spot.beam_width, 0.75f * 0.349066f, 1e-6f);
    const auto& sun = std::get<DirectionalEmitter>(emitters[2].model);
    expect_near(sun.direction, {0, -1, 0}, 0);
    expect_near(sun.irradiance, {3 * 1.2048f, 3 * 0.9482f, 3 * 0.9089f}, 1e-3f); // the same at all wavelengths: equal-energy white
    expect_near(std::get<ConstantEmitter>(emitters[3].model).radiance, {0.21404f, 0.21404f, 0.21404f}, 1e-5f);
    EXPECT_EQ(std::get<PointEmitter>(emitters[4].model).intensity, std::get<PointEmitter>(emitters[5].model).intensity);
    EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(ImportScene, OneNumberAsEmissionIsGreyInOldScenes)
{
    const auto loaded = SceneFolder().load(R"(<scene version="0.6.0"><sensor type="perspective"/><shape type="sphere"/>
        <emitter type="constant"><spectrum name="radiance" value="3"/></emitter></scene>)");
    EXPECT_EQ(std::get<ConstantEmitter>(loaded.scene.emitters.at(0).model).radiance, (Vec3{3, 3, 3}));
}

TEST(ImportScene, WhatChangesNothingIsNamed)
{
    const auto loaded = SceneFolder().load(R"(<scene version="3.0.0">
<integrator type="aov"><string name="aovs" value="dd.y:depth"/>
<integrator type="path"><integer name="maxDepth" value="5"/><integer name="samplesPerPass" value="2"/></integrator></integrator>
<sensor type="perspective">
<film type="hdrfilm">
<string name="pixel_format" value="rgb"/>
<boolean name="banner" value="false"/></film>
<sampler type="multijitter"/>
</sensor>
<shape type="rectangle">
<emitter type="area"><float name="samplingWeight" value="2"/></emitter>
<bsdf type="diffuse"><rgb name="reflectance" value="1.5, 0, 0"/></bsdf>
</shape>
<emitter type="point"><rgb name="intensity" value="0"/></emitter>
</scene>)");
    EXPECT_EQ(loaded.scene.integrator.method, "path");
    EXPECT_EQ(loaded.scene.integrator.parameters.size(), 1u);
    EXPECT_TRUE(loaded.scene.emitters.empty());
    EXPECT_THAT(loaded.warnings,
                ElementsAre(HasSubstr(":6: parameter 'pixel_format'"), HasSubstr(":7: parameter 'banner'"),
                            HasSubstr(":8: sampler 'multijitter'"), HasSubstr(":11: parameter 'sampling_weight'"),
                            HasSubstr(":12: 'reflectance' is outside of [0, 1]"), HasSubstr(":2: integrator 'aov'"),
                            HasSubstr(":3: parameter 'samples_per_pass'"), HasSubstr(":14: a light that emits nothing")));
}

TEST(ImportScene, PhotonMapperNamesOfMitsuba06)
{
    const auto loaded =
        load_with(R"(<integrator type="sppm"><integer name="photonCount" value="1000"/><float name="initialRadius" value="0.1"/>
        <integer name="maxPasses" value="3"/><float name="alpha" value=".7"/></integrator>)",
                  {}, "0.6.0");
    const auto& parameters = loaded.scene.integrator.parameters;
    EXPECT_EQ(parameters.at("photons").value, "1000");
    EXPECT_EQ(parameters.at("radius").value, "0.1");
    EXPECT_EQ(parameters.at("iterations").value, "3");
    EXPECT_EQ(parameters.at("alpha").value, ".7");
}

TEST(ImportScene, SpectraOfSamplesAndFiles)
{
    const SceneFolder folder;
    folder.write("red.spd", "# measured\n600 0.0\n\n610 0.9 # rising\n830, 0.9\n");
    const auto loaded = folder.load(sundog::testing::scene_with(R"(
        <shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="600:0, 610:0.9, 830:0.9"/></bsdf></shape>
        <shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" filename="red.spd"/></bsdf></shape>)"));
    const Vec3 inline_red = bsdf_of<DiffuseBsdf>(loaded, 0).reflectance.value;
    EXPECT_EQ(inline_red, bsdf_of<DiffuseBsdf>(loaded, 1).reflectance.value);
    EXPECT_GT(inline_red.x, 5 * inline_red.y);
}

} // namespace
