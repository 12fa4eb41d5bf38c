// The scene on the device. Kernels take it whole: as geometry (what traversal needs) or surfaces (what
// shading needs), in the order of kernels/shared/scene_arrays.h.
#pragma once

#include "device/kernel.h"
#include "scene/flat_scene.h"

namespace sundog {

class DeviceScene {
public:
    // Builds the hierarchy and uploads everything.
    DeviceScene(Device& device, const Scene& scene);

    // Arguments for GEOMETRY_PARAMETERS and SURFACE_PARAMETERS.
    struct Geometry {
        const DeviceScene* scene;
    };
    struct Surfaces {
        const DeviceScene* scene;
    };
    Geometry geometry() const { return {this}; }
    Surfaces surfaces() const { return {this}; }

    // What kernels that trace rays are specialised for.
    BuildOptions trace_options() const;

    Vec3 center() const { return host_globals_.center; }
    float radius() const { return host_globals_.radius; } // of the bounding sphere
    const Bounds& bounds() const { return bounds_; }

private:
    friend void bind(ArgumentBinder&, const Geometry&);
    friend void bind(ArgumentBinder&, const Surfaces&);

    SceneGlobals host_globals_{};
    Bounds bounds_;
    bool has_analytics_ = false;
    Buffer<SceneGlobals> globals;
#define AS_BUFFER(type, name) Buffer<type> name;
    GEOMETRY_ARRAYS(AS_BUFFER)
    SURFACE_ARRAYS(AS_BUFFER)
#undef AS_BUFFER
};

void bind(ArgumentBinder& binder, const DeviceScene::Geometry& geometry);
void bind(ArgumentBinder& binder, const DeviceScene::Surfaces& surfaces);

} // namespace sundog
