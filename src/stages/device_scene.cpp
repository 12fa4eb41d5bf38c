#include "stages/device_scene.h"

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
    const FlatScene flat = flatten_scene(scene);
    const Bvh bvh = build_bvh({flat.positions, flat.triangles, flat.analytics});
    bounds_ = bvh.bounds;
    trace_options_ = sundog::trace_options(flat.analytics);
    geometry_ = upload_geometry(device, bvh, flat.analytics, flat.globals);
#define UPLOAD(type, name) name = upload(device, flat.name, #name);
    SURFACE_ARRAYS(UPLOAD)
#undef UPLOAD
}

void bind(ArgumentBinder& binder, const DeviceScene::Surfaces& surfaces)
{
    const DeviceScene& scene = *surfaces.scene;
    bind(binder, scene.geometry_.globals);
    bind(binder, scene.geometry_.analytics);
#define BIND(type, name) bind(binder, scene.name);
    SURFACE_ARRAYS(BIND)
#undef BIND
}

} // namespace sundog
