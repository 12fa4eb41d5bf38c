#include "app/scene_summary.h"

#include "methods/method.h"
#include "scene/flat_scene.h"
#include "scene/scene_bvh.h"
#include "shared/film.h"

#include <variant>

namespace sundog {

namespace {

const char* kind(const TriangleMesh&) { return "mesh"; }
const char* kind(const Sphere&) { return "sphere"; }
const char* kind(const Disk&) { return "disk"; }
const char* kind(const Cylinder&) { return "cylinder"; }
const char* kind(const DiffuseBsdf&) { return "diffuse"; }
const char* kind(const DielectricBsdf& bsdf) { return bsdf.thin ? "thindielectric" : bsdf.roughness ? "roughdielectric" : "dielectric"; }
const char* kind(const ConductorBsdf& bsdf) { return bsdf.roughness ? "roughconductor" : "conductor"; }
const char* kind(const PlasticBsdf& bsdf)
{
    return bsdf.roughness ? "roughplastic" : "plastic";
}
const char* kind(const PrincipledBsdf&)
{
    return "principled";
}
const char* kind(const PhongBsdf&)
{
    return "phong";
}
const char* kind(const CoatingBsdf& bsdf)
{
    return bsdf.roughness ? "roughcoating" : "coating";
}
const char* kind(const MaskBsdf&) { return "mask"; }
const char* kind(const BlendBsdf&) { return "blendbsdf"; }
const char* kind(const NormalMapBsdf&)
{
    return "normalmap";
}
const char* kind(const BumpMapBsdf&)
{
    return "bumpmap";
}
const char* kind(const NullBsdf&) { return "null"; }
const char* kind(const TwoSidedBsdf&) { return "twosided"; }
const char* kind(const PointEmitter&) { return "point"; }
const char* kind(const SpotEmitter&) { return "spot"; }
const char* kind(const DirectionalEmitter&) { return "directional"; }
const char* kind(const ConstantEmitter&) { return "constant"; }
const char* kind(const EnvironmentEmitter&) { return "envmap"; }
const char* kind(const SunSkyEmitter& emitter)
{
    return emitter.sun_scale == 0.0f ? "sky" : emitter.sky_scale == 0.0f ? "sun" : "sunsky";
}
const char* kind(const ProjectorEmitter&) { return "projector"; }
const char* kind(const CollimatedEmitter&) { return "collimated"; }

template <class Variant> void count(std::map<std::string, std::size_t>& counts, const Variant& variant)
{
    ++counts[std::visit([](const auto& value) { return kind(value); }, variant)];
}

const char* filter_name(FilterKind filter)
{
    switch (filter) {
    case FilterKind::box: return "box";
    case FilterKind::tent: return "tent";
    case FilterKind::gaussian: return "gaussian";
    case FilterKind::mitchell: return "mitchell";
    case FilterKind::lanczos: return "lanczos";
    }
    return "";
}

template <class T> std::uint64_t bytes_of(const std::vector<T>& array) { return array.size() * sizeof(T); }

std::uint64_t device_bytes(const FlatScene& flat, const Bvh& bvh)
{
    return bytes_of(flat.positions) + bytes_of(flat.normals) + bytes_of(flat.triangles) + bytes_of(flat.analytics) + bytes_of(flat.shapes) + bytes_of(flat.bsdfs) + bytes_of(flat.principled) +
           bytes_of(flat.lights) + bytes_of(flat.light_alias) + bytes_of(flat.light_tree) + bytes_of(flat.light_projections) + bytes_of(flat.environment_maps) +
           bytes_of(flat.environment_alias) + bytes_of(flat.uvs) + bytes_of(flat.textures) + bytes_of(flat.texels) + bytes_of(flat.attribute_ranges) +
           bytes_of(flat.attribute_values) + sizeof(SceneGlobals) + bytes_of(bvh.instances) + bytes_of(bvh.nodes) + bytes_of(bvh.blocks);
}

// The same checks as before a render.
void check_integrator(const IntegratorRequest& request)
{
    if (request.method.empty()) return;
    const MethodInfo* method = find_method(request.method);
    if (!method) throw SceneError(request.where, "unknown method \"" + request.method + "\"; sundog methods lists them, --method chooses another");
    std::map<std::string, ParameterValue> values;
    for (const auto& [name, text] : request.parameters) values[name] = {text.value, text.where};
    Parameters(request.method, method->parameters, values);
}

} // namespace

SceneSummary summarize(const Scene& scene)
{
    check_integrator(scene.integrator);
    const FlatScene flat = flatten_scene(scene);
    const Bvh bvh = build_scene_bvh(flat);

    SceneSummary summary;
    summary.file = scene.file;
    for (const ShapeDescription& shape : scene.shapes) {
        count(summary.shapes, shape.geometry);
        if (shape.emitter) ++summary.emitters["area"];
    }
    for (const BsdfDescription& bsdf : scene.bsdfs) count(summary.bsdfs, bsdf.model);
    for (const EmitterDescription& emitter : scene.emitters) count(summary.emitters, emitter.model);
    summary.triangles = scene.triangle_count();
    summary.triangles_with_copies = scene.triangle_count_with_copies();
    summary.groups = scene.groups.size();
    summary.instances = scene.instances.size();
    summary.shutter = scene.sensor.shutter;
    summary.camera_moves = flat.sensor_motion.has_value();
    summary.moving_instances = flat.instance_motions.size();
    summary.lights = flat.lights.size();
    summary.bounds = scene.bounds();
    summary.width = scene.film.crop_width;
    summary.height = scene.film.crop_height;
    summary.filter = filter_name(scene.film.filter.kind);
    summary.method = scene.integrator.method;
    for (const auto& [name, text] : scene.integrator.parameters) summary.parameters[name] = text.value;
    summary.scene_bytes = device_bytes(flat, bvh);
    summary.film_bytes = static_cast<std::uint64_t>(summary.width) * static_cast<std::uint64_t>(summary.height) * (sizeof(FilmPixel) + sizeof(FirstHitPixel));
    return summary;
}

} // namespace sundog
