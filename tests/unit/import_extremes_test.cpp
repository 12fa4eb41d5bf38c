// Every numeric parameter of every plugin that is no shape, at values that no scene has: each is refused at its line, or all that the
// device gets is finite, and so are reflectances computed from it.
#include "scene/flat_scene.h"
#include "scene/scene_bvh.h"
#include "unit/scene_folder.h"

#include <cmath>
#include <initializer_list>

namespace
{

using namespace sundog;
using sundog::testing::SceneFolder;

constexpr const char* extremes[] = {"0",    "1e-40", "1e-30", "1e-10",  "1e-3", "1",     "1e3", "1e10", "1e19",
                                    "1e30", "3e38",  "1e300", "-1e-30", "-1",   "-1e30", "nan", "inf"};

bool all_finite(std::initializer_list<float> values)
{
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

bool all_finite(Vec3 v)
{
    return is_finite(v);
}

void expect_finite(const Bsdf& bsdf)
{
    EXPECT_TRUE(all_finite({bsdf.eta, bsdf.alpha_u.value, bsdf.alpha_v.value, bsdf.weight.value, bsdf.sellmeier_b4, bsdf.sellmeier_c4}));
    EXPECT_TRUE(all_finite(bsdf.reflectance.value) && all_finite(bsdf.specular.value) && all_finite(bsdf.transmittance.value));
    EXPECT_TRUE(all_finite(bsdf.eta_rgb) && all_finite(bsdf.k_rgb));
    // [Born and Wolf, section 14.2] takes the fourth power of a conductor's index, Fresnel's equations the square of a glass's.
    const Vec3 eta2 = bsdf.eta_rgb * bsdf.eta_rgb, k2 = bsdf.k_rgb * bsdf.k_rgb;
    EXPECT_TRUE(all_finite(eta2 * eta2 + k2 * k2 + 4.0f * eta2 * k2));
    EXPECT_TRUE(all_finite({bsdf.eta * bsdf.eta, 1.0f / (bsdf.eta * bsdf.eta)}));
}

void expect_finite(const Camera& camera)
{
    EXPECT_TRUE(all_finite(camera.position) && all_finite(camera.axis_x) && all_finite(camera.axis_y) && all_finite(camera.axis_z));
    EXPECT_TRUE(all_finite({camera.half_width, camera.half_height, camera.aperture_radius, camera.focus_distance, camera.near_clip,
                            camera.far_clip, camera.shift_x, camera.shift_y, camera.aperture_radius / camera.focus_distance}));
    const float area = camera.half_width * camera.half_height;
    EXPECT_TRUE(std::isnormal(area)) << area;
}

void expect_finite(const Light& light)
{
    EXPECT_TRUE(all_finite(light.emission) && all_finite(light.emission * light.emission));
    EXPECT_TRUE(all_finite(light.position) && all_finite(light.direction));
    EXPECT_TRUE(all_finite({light.probability, light.area, light.cutoff_angle, light.beam_width}));
}

void expect_finite(const Scene& scene)
{
    const FlatScene flat = flatten_scene(scene);
    for (const Bsdf& bsdf : flat.bsdfs) expect_finite(bsdf);
    for (const Principled& p : flat.principled)
        EXPECT_TRUE(all_finite({p.roughness.value, p.anisotropic.value, p.metallic.value, p.spec_trans.value, p.spec_tint.value,
                                p.sheen.value, p.sheen_tint.value, p.flatness.value, p.clearcoat.value, p.clearcoat_gloss.value}));
    for (const Light& light : flat.lights) expect_finite(light);
    for (const AliasEntry& entry : flat.light_alias) EXPECT_TRUE(std::isfinite(entry.threshold));
    for (const Vec3& position : flat.positions) EXPECT_TRUE(all_finite(position));
    for (const AnalyticPrimitive& p : flat.analytics)
        EXPECT_TRUE(all_finite(p.center) && all_finite(p.axis_u) && all_finite(p.axis_v) && all_finite(p.normal) && all_finite({p.radius}));
    EXPECT_TRUE(all_finite(flat.globals.center) && all_finite({flat.globals.radius, flat.globals.radius * flat.globals.radius}));
    expect_finite(make_camera(scene.sensor, scene.film));
    const PixelFilter filter = make_pixel_filter(scene.film.filter);
    for (int i = 0; i < FILTER_BINS; i++) EXPECT_TRUE(all_finite({filter.cdf[i], filter.sign_scale[i], filter.density[i]}));
    build_scene_bvh(flat);
}

// `object` may have parameters of its own before; the extreme is on line 3.
std::string with_number(const std::string& head, const std::string& name, const std::string& value, const std::string& tail,
                        const char* tag = "float")
{
    return "<scene version=\"3.0.0\">\n" + head + "\n<" + tag + " name=\"" + name + "\" value=\"" + value + "\"/>\n" + tail + "</scene>";
}

const std::string rest = "<sensor type=\"perspective\"/><shape type=\"rectangle\"><emitter type=\"area\"/></shape>";

struct Plugin {
    const char* name;
    std::string head; // up to the parameter
    std::string tail; // after it
    std::vector<const char*> numbers;
    const char* tag = "float";
};

Plugin bsdf(const char* type, std::vector<const char*> numbers, const std::string& inside = "", const char* tag = "float")
{
    return {type, "<shape type=\"sphere\"><bsdf type=\"" + std::string(type) + "\">" + inside, "</bsdf></shape>" + rest, std::move(numbers),
            tag};
}

Plugin emitter(const char* type, std::vector<const char*> numbers, const char* tag = "float")
{
    return {type, "<emitter type=\"" + std::string(type) + "\">", "</emitter>" + rest, std::move(numbers), tag};
}

Plugin sensor(const char* type, const std::string& inside, const std::string& end, std::vector<const char*> numbers,
              const char* tag = "float")
{
    return {type, "<sensor type=\"" + std::string(type) + "\">" + inside,
            end + "</sensor><shape type=\"cube\"/><emitter type=\"constant\"/>", std::move(numbers), tag};
}

const std::string base = "<bsdf type=\"diffuse\"/>";
const std::string texture = "<texture type=\"checkerboard\" name=\"t\"/>";

const std::vector<Plugin> plugins = {
    bsdf("dielectric", {"int_ior", "ext_ior"}),
    bsdf("thindielectric", {"int_ior", "ext_ior"}),
    bsdf("roughdielectric", {"int_ior", "ext_ior", "alpha", "alpha_u", "alpha_v"}),
    bsdf("plastic", {"int_ior", "ext_ior", "diffuse_reflectance", "specular_reflectance"}),
    bsdf("roughplastic", {"int_ior", "ext_ior", "alpha"}),
    bsdf("conductor", {"eta", "k", "ext_eta", "specular_reflectance"}),
    bsdf("roughconductor", {"eta", "k", "alpha", "alpha_u", "alpha_v"}),
    bsdf("conductor", {"eta", "k"}, "", "rgb"),
    bsdf("conductor", {"eta"}, "<float name=\"k\" value=\"0\"/>"),
    bsdf("conductor", {"k"}, "<float name=\"eta\" value=\"0\"/>"),
    bsdf("conductor", {"ext_eta"}, "<float name=\"eta\" value=\"1e7\"/>"),
    bsdf("principled", {"eta", "specular", "roughness", "anisotropic", "metallic", "spec_trans", "spec_tint", "sheen", "sheen_tint",
                        "flatness", "clearcoat", "clearcoat_gloss"}),
    bsdf("principled", {"eta"}, "<float name=\"spec_trans\" value=\"1\"/>"),
    bsdf("phong", {"exponent"}),
    bsdf("diffuse", {"reflectance"}, "", "rgb"),
    bsdf("diffuse", {"reflectance"}, "", "spectrum"),
    bsdf("mask", {"opacity"}, base),
    bsdf("mask", {"opacity"}, base, "spectrum"),
    bsdf("blendbsdf", {"weight"}, base + base),
    bsdf("bumpmap", {"scale"}, base + texture),
    bsdf("mixturebsdf", {"weights"}, base, "string"),
    emitter("point", {"intensity"}, "rgb"),
    emitter("point", {"intensity"}, "spectrum"),
    emitter("point", {"position"}, "point"),
    emitter("spot", {"cutoff_angle", "beam_width", "intensity"}),
    emitter("directional", {"irradiance"}),
    emitter("directional", {"direction"}, "vector"),
    emitter("constant", {"radiance"}),
    emitter("collimated", {"power"}),
    emitter("projector", {"scale", "fov", "irradiance"}),
    {"area", "<shape type=\"disk\"><emitter type=\"area\">", "</emitter></shape>" + rest, {"radiance"}, "rgb"},
    {"blackbody",
     "<emitter type=\"constant\"><spectrum name=\"radiance\" type=\"blackbody\"><float name=\"scale\" value=\"1e10\"/>",
     "</spectrum></emitter>" + rest,
     {"temperature"}},
    {"uniform",
     "<emitter type=\"constant\"><spectrum name=\"radiance\" type=\"uniform\"><float name=\"scale\" value=\"1e10\"/>",
     "</spectrum></emitter>" + rest,
     {"value"}},
    sensor("perspective", "", "",
           {"fov", "near_clip", "far_clip", "focus_distance", "principal_point_offset_x", "principal_point_offset_y", "shutter_close"}),
    sensor("perspective", "<string name=\"fov_axis\" value=\"y\"/>", "", {"fov"}),
    sensor("perspective", "", "", {"focal_length"}, "string"),
    sensor("thinlens", "", "", {"aperture_radius"}),
    sensor("thinlens", "<float name=\"aperture_radius\" value=\"1\"/>", "", {"focus_distance", "far_clip"}),
    sensor("orthographic", "", "", {"near_clip", "far_clip"}),
    sensor("telecentric", "", "", {"aperture_radius"}),
    sensor("perspective", "<film type=\"hdrfilm\"><rfilter type=\"gaussian\">", "</rfilter></film>", {"stddev"}),
    sensor("perspective", "<film type=\"hdrfilm\"><rfilter type=\"box\">", "</rfilter></film>", {"radius"}),
    sensor("perspective", "<film type=\"hdrfilm\"><rfilter type=\"tent\">", "</rfilter></film>", {"radius"}),
    sensor("perspective", "<film type=\"hdrfilm\"><rfilter type=\"mitchell\">", "</rfilter></film>", {"b", "c"}),
};

TEST(ImportExtremes, AreRefusedAtTheirLineOrFinite)
{
    const SceneFolder folder;
    int loaded = 0, refused = 0;
    for (const Plugin& plugin : plugins)
        for (const char* name : plugin.numbers)
            for (const char* value : extremes) {
                SCOPED_TRACE(std::string(plugin.name) + " " + name + " " + value);
                try {
                    LoadedScene scene = folder.load(with_number(plugin.head, name, value, plugin.tail, plugin.tag));
                    expect_finite(scene.scene);
                    loaded++;
                } catch (const SceneError& error) {
                    EXPECT_NE(std::string(error.what()).find("scene.xml:"), std::string::npos) << error.what();
                    refused++;
                }
            }
    EXPECT_GT(loaded, 200);
    EXPECT_GT(refused, 200);
}

// Such values are at the edge of what is taken, and sure to be there.
TEST(ImportExtremes, EdgesLoad)
{
    const SceneFolder folder;
    const auto loads = [&](const Plugin& plugin, const char* name, const char* value) {
        expect_finite(folder.load(with_number(plugin.head, name, value, plugin.tail, plugin.tag)).scene);
    };
    loads(bsdf("roughplastic", {}), "alpha", "100");
    loads(bsdf("conductor", {}), "eta", "1e8");
    loads(bsdf("conductor", {}, "<float name=\"k\" value=\"0\"/>"), "eta", "0");
    loads(bsdf("plastic", {}), "int_ior", "100");
    loads(bsdf("plastic", {}, "<float name=\"ext_ior\" value=\"1\"/>"), "int_ior", "0.01");
    loads(bsdf("principled", {}), "specular", "12");
    loads(emitter("constant", {}), "radiance", "1e18");
    loads(sensor("perspective", "", "", {}), "fov", "1.2e-5");
    loads(sensor("perspective", "", "", {}), "fov", "179.99999");
}

} // namespace
