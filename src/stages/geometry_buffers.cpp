#include "stages/geometry_buffers.h"

namespace sundog
{

GeometryBuffers upload_geometry(Device& device, const Bvh& bvh, std::span<const AnalyticPrimitive> analytics, SceneGlobals globals)
{
    if (globals.radius == 0.0f && !bvh.bounds.empty()) {
        globals.center = bvh.bounds.center();
        globals.radius = bvh.bounds.radius();
    }
    globals.bvh_root = bvh.root;
    GeometryBuffers buffers;
    buffers.globals = Buffer<SceneGlobals>(device, std::span<const SceneGlobals>(&globals, 1), "scene globals");
    buffers.bvh_nodes = Buffer<BvhNode>(device, bvh.nodes, "hierarchy nodes");
    buffers.bvh_blocks = Buffer<BvhBlock>(device, bvh.blocks, "hierarchy triangle blocks");
    buffers.analytics = Buffer<AnalyticPrimitive>(device, analytics, "spheres and disks");
    buffers.instances = Buffer<Instance>(device, bvh.instances, "instances");
    return buffers;
}

BuildOptions trace_options(std::span<const AnalyticPrimitive> analytics, std::span<const Instance> instances)
{
    BuildOptions options;
    if (!analytics.empty()) options.defines.emplace_back("HAS_ANALYTIC", "1");
    if (!instances.empty()) options.defines.emplace_back("HAS_INSTANCES", "1");
    return options;
}

void bind(ArgumentBinder& binder, const GeometryBuffers& geometry)
{
    bind(binder, geometry.globals);
#define BIND_BUFFER(type, name) bind(binder, geometry.name);
    GEOMETRY_ARRAYS(BIND_BUFFER)
#undef BIND_BUFFER
}

} // namespace sundog
