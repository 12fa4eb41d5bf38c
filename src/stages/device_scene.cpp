#include "stages/device_scene.h"

#include "device/environment.h"
#include "scene/flatten_bsdfs.h"
#include "scene/scene_bvh.h"

namespace sundog {

namespace {

// Kernels take every array, so an empty one becomes one unused element.
template <class T> Buffer<T> upload(Device& device, const std::vector<T>& data, const char* name)
{
    const std::string label = std::string("scene ") + name;
    return data.empty() ? Buffer<T>(device, std::vector<T>(1), label) : Buffer<T>(device, data, label);
}

BuildOptions surface_options(const FlatScene& flat, bool spectral)
{
    BuildOptions options;
    if (!environment_number("SUNDOG_GENERAL_PROGRAMS")) { // else kernels take all types: one set of programs serves every scene
        options.defines.emplace_back("BSDF_TYPES", std::to_string(bsdf_types(flat.bsdfs)) + "u");
        options.defines.emplace_back("LOBE_TYPES", std::to_string(lobe_types(flat.bsdfs)) + "u");
        options.defines.emplace_back("LIGHT_TYPES", std::to_string(light_types(flat)) + "u");
        options.defines.emplace_back("HAS_UV", needs_texture_coordinates(flat) ? "1" : "0");
    }
    if (!flat.light_tree.empty()) options.defines.emplace_back("LIGHT_TREE", "1");
    if (!flat.instances.empty()) options.defines.emplace_back("HAS_INSTANCES", "1");
    if (flat.hides_emitters) options.defines.emplace_back("HIDE_EMITTERS", "1");
    // Without these definitions the programs are those of RGB transport, to the last bit.
    if (spectral) options.defines.emplace_back("SPECTRAL", "1");
    if (spectral && has_dispersion(flat.bsdfs)) options.defines.emplace_back("DISPERSION", "1");
    return options;
}

FlatScene flatten(const Scene& scene, LightSelection selection)
{
    FlatScene flat = flatten_scene(scene);
    const bool many = flat.lights.size() >= lights_for_a_tree;
    if (selection == LightSelection::tree || (selection == LightSelection::automatic && many)) flat.light_tree = build_light_tree(flat);
    return flat;
}

} // namespace

DeviceScene::DeviceScene(Device& device, const Scene& scene, bool spectral, LightSelection selection) : spectral_(spectral)
{
    FlatScene flat = flatten(scene, selection);
    const Bvh bvh = build_scene_bvh(flat);
    bounds_ = bvh.bounds;
    trace_options_ = sundog::trace_options(flat.analytics, flat.instances);
    if (flat.hides_emitters) trace_options_.defines.emplace_back("HIDE_EMITTERS", "1");
    surface_options_ = sundog::surface_options(flat, spectral);
    has_delta_lights_ = sundog::has_delta_lights(flat);
    has_lobes_to_evaluate_ = sundog::has_lobes_to_evaluate(flat.bsdfs);
    has_focused_light_ = sundog::has_focused_light(flat);
    geometry_ = upload_geometry(device, bvh, flat.analytics, flat.globals);
    globals_ = geometry_.globals.read(0);
#define UPLOAD(type, name) name = upload(device, flat.name, #name);
    SURFACE_ARRAYS(UPLOAD)
#undef UPLOAD
    if (flat.instance_motions.empty()) return;
    instances_ = bvh.instances;
    instance_motions_ = std::move(flat.instance_motions);
}

void DeviceScene::set_time(double time)
{
    if (instance_motions_.empty()) return;
    for (const auto& [instance, to_world] : instance_motions_) place(to_world.at(time), instances_[instance]);
    geometry_.instances.upload(instances_);
}

void DeviceScene::set_wavelengths(const Wavelengths& wavelengths)
{
    globals_.wavelengths = wavelengths;
    geometry_.globals.upload(std::span<const SceneGlobals>(&globals_, 1));
}

void bind(ArgumentBinder& binder, const DeviceScene::Surfaces& surfaces)
{
    const DeviceScene& scene = *surfaces.scene;
    bind(binder, scene.geometry_.globals);
    bind(binder, scene.geometry_.analytics);
    bind(binder, scene.geometry_.instances);
#define BIND(type, name) bind(binder, scene.name);
    SURFACE_ARRAYS(BIND)
#undef BIND
}

} // namespace sundog
