// What rays hit, on the device.
#pragma once

#include "device/kernel.h"
#include "scene/bvh_build.h"
#include "shared/scene_arrays.h"

namespace sundog
{

// Binds as GEOMETRY_PARAMETERS.
struct GeometryBuffers {
    Buffer<SceneGlobals> globals;
#define GEOMETRY_BUFFER(type, name) Buffer<type> name;
    GEOMETRY_ARRAYS(GEOMETRY_BUFFER)
#undef GEOMETRY_BUFFER
};

// globals.bvh_root follows from the hierarchy, and so do center and radius where the radius given is 0; the other
// members are kept.
GeometryBuffers upload_geometry(Device& device, const Bvh& bvh, std::span<const AnalyticPrimitive> analytics, SceneGlobals globals = {});

// Specialises trace_closest and trace_any for what the geometry contains.
BuildOptions trace_options(std::span<const AnalyticPrimitive> analytics, std::span<const Instance> instances = {});

void bind(ArgumentBinder& binder, const GeometryBuffers& geometry);

} // namespace sundog
