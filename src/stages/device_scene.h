// The scene on the device. Kernels take it whole: as geometry (what traversal needs) or surfaces (what
// shading needs), in the order of kernels/shared/scene_arrays.h.
#pragma once

#include "scene/flat_scene.h"
#include "scene/light_tree.h"
#include "stages/geometry_buffers.h"

namespace sundog {

class DeviceScene {
public:
    // Builds the hierarchies and uploads everything. spectral: kernels compute with wavelengths, which set_wavelengths()
    // has to choose before each pass.
    DeviceScene(Device& device, const Scene& scene, bool spectral = false, LightSelection selection = LightSelection::automatic);

    bool is_spectral() const { return spectral_; }
    void set_wavelengths(const Wavelengths& wavelengths);

    // Places all instances that move where they are at a time that the shutter is open. At first they are where it opens.
    void set_time(double time);

    // Arguments for GEOMETRY_PARAMETERS and SURFACE_PARAMETERS.
    struct Surfaces {
        const DeviceScene* scene;
    };
    const GeometryBuffers& geometry() const { return geometry_; }
    Surfaces surfaces() const { return {this}; }

    // What kernels that trace rays are specialised for.
    const BuildOptions& trace_options() const { return trace_options_; }

    // What kernels that look at surfaces are specialised for: the types of BSDF, and whether there are textures.
    const BuildOptions& surface_options() const { return surface_options_; }

    bool has_delta_lights() const { return has_delta_lights_; }               // see the function of that name
    bool has_lobes_to_evaluate() const { return has_lobes_to_evaluate_; } // the same
    bool has_focused_light() const { return has_focused_light_; }         // the same

    float radius() const { return bounds_.radius(); } // of the bounding sphere
    const Bounds& bounds() const { return bounds_; }

private:
    friend void bind(ArgumentBinder&, const Surfaces&);

    bool spectral_;
    SceneGlobals globals_; // what the device has
    std::vector<Instance> instances_; // the same, of scenes where some move
    std::vector<InstanceMotion> instance_motions_;
    Bounds bounds_;
    BuildOptions trace_options_;
    BuildOptions surface_options_;
    bool has_delta_lights_;
    bool has_lobes_to_evaluate_;
    bool has_focused_light_;
    GeometryBuffers geometry_;
#define AS_BUFFER(type, name) Buffer<type> name;
    SURFACE_ARRAYS(AS_BUFFER)
#undef AS_BUFFER
};

void bind(ArgumentBinder& binder, const DeviceScene::Surfaces& surfaces);

} // namespace sundog
