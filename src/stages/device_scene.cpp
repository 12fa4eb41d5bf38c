#include "stages/device_scene.h"

#include "scene/bvh_build.h"

namespace sundog {

namespace {

// Kernels take every array, so an empty one becomes one unused element.
template <class T> Buffer<T> upload(Device& device, const std::vector<T>& data, const char* name)
{
    const std::string label = std::string("scene ") + name;
    return data.empty() ? Buffer<T>(device, std::vector<T>(1), label) : Buffer<T>(device, data, label);
}

} // namespace

DeviceScene::DeviceScene(Device& device, const Scene& scene)
{
    FlatScene flat = flatten_scene(scene);
    const Bvh bvh = build_bvh({flat.positions, flat.triangles, flat.analytics});
    flat.globals.bvh_root = bvh.root;
    host_globals_ = flat.globals;
    bounds_ = bvh.bounds;
    has_analytics_ = !flat.analytics.empty();

    globals = Buffer<SceneGlobals>(device, std::vector{flat.globals}, "scene globals");
    bvh_nodes = upload(device, bvh.nodes, "bvh_nodes");
    bvh_blocks = upload(device, bvh.blocks, "bvh_blocks");
#define UPLOAD(type, name) name = upload(device, flat.name, #name);
    UPLOAD(AnalyticPrimitive, analytics)
    SURFACE_ARRAYS(UPLOAD)
#undef UPLOAD
}

BuildOptions DeviceScene::trace_options() const
{
    BuildOptions options;
    if (has_analytics_) options.defines.emplace_back("HAS_ANALYTIC", "1");
    return options;
}

#define BIND(type, name) bind(binder, scene.name);

void bind(ArgumentBinder& binder, const DeviceScene::Geometry& geometry)
{
    const DeviceScene& scene = *geometry.scene;
    bind(binder, scene.globals);
    GEOMETRY_ARRAYS(BIND)
}

void bind(ArgumentBinder& binder, const DeviceScene::Surfaces& surfaces)
{
    const DeviceScene& scene = *surfaces.scene;
    bind(binder, scene.globals);
    bind(binder, scene.analytics);
    SURFACE_ARRAYS(BIND)
}

#undef BIND

} // namespace sundog
