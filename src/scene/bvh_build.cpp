#include "scene/bvh_build.h"

#include "base/errors.h"
#include "scene/bvh_flatten.h"
#include "scene/bvh_primitives.h"
#include "shared/ray.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

namespace sundog
{
namespace
{

// --- Conversions to and from Embree's primitives ------------------------------------
// primID holds the triangle's or analytic primitive's index, geomID which of the two it
// is, in its lowest bit: Embree counts splits in the upper ones.

uint id_of(const RTCBuildPrimitive& primitive)
{
    return primitive.geomID & 1u ? primitive.primID | ANALYTIC_BIT : primitive.primID;
}

RTCBuildPrimitive to_embree(const BvhPrimitive& primitive)
{
    RTCBuildPrimitive result;
    result.lower_x = primitive.bounds.lower.x, result.lower_y = primitive.bounds.lower.y, result.lower_z = primitive.bounds.lower.z;
    result.upper_x = primitive.bounds.upper.x, result.upper_y = primitive.bounds.upper.y, result.upper_z = primitive.bounds.upper.z;
    result.geomID = primitive.id & ANALYTIC_BIT ? 1 : 0;
    result.primID = primitive.id & ~ANALYTIC_BIT;
    return result;
}

void store(const Bounds& bounds, RTCBounds* result)
{
    result->lower_x = bounds.lower.x, result->lower_y = bounds.lower.y, result->lower_z = bounds.lower.z;
    result->upper_x = bounds.upper.x, result->upper_y = bounds.upper.y, result->upper_z = bounds.upper.z;
}

// --- Embree's callbacks ----------------------------------------------------------------

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*)
{
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuildInner), alignof(BuildInner))) BuildInner();
}

void set_children(void* node, void** children, unsigned count, void*)
{
    BuildInner& inner = *static_cast<BuildInner*>(node);
    inner.count = static_cast<int>(count);
    for (unsigned i = 0; i < count; i++) inner.children[i] = static_cast<BuildNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*)
{
    BuildInner& inner = *static_cast<BuildInner*>(node);
    for (unsigned i = 0; i < count; i++) {
        inner.bounds[i] = {{bounds[i]->lower_x, bounds[i]->lower_y, bounds[i]->lower_z},
                           {bounds[i]->upper_x, bounds[i]->upper_y, bounds[i]->upper_z}};
    }
}

// Spatial splits may bring the same primitive into a leaf twice.
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*)
{
    assert(count <= BuildLeaf::capacity);
    BuildLeaf* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuildLeaf), alignof(BuildLeaf))) BuildLeaf();
    for (std::size_t i = 0; i < count; i++) leaf->ids[i] = id_of(primitives[i]);
    std::sort(leaf->ids, leaf->ids + count);
    leaf->count = static_cast<int>(std::unique(leaf->ids, leaf->ids + count) - leaf->ids);
    return static_cast<BuildNode*>(leaf);
}

void split_primitive(const RTCBuildPrimitive* primitive, unsigned dimension, float position, RTCBounds* left, RTCBounds* right,
                     void* context)
{
    const Bounds box{{primitive->lower_x, primitive->lower_y, primitive->lower_z},
                     {primitive->upper_x, primitive->upper_y, primitive->upper_z}};
    const BvhGeometry& geometry = *static_cast<const BvhGeometry*>(context);
    const SplitBounds parts = split_bounds(geometry, id_of(*primitive), box, static_cast<int>(dimension), position);
    store(parts.below, left);
    store(parts.above, right);
}

// --- The build ---------------------------------------------------------------------------

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

[[noreturn]] void throw_build_error(RTCDevice device, std::size_t count)
{
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        throw SceneError({}, "not enough memory to build the hierarchy of " + std::to_string(count) + " primitives; use coarser meshes");
    throw std::logic_error("rtcBuildBVH failed with error " + std::to_string(static_cast<int>(error)));
}

RTCBuildArguments build_arguments(const BvhSettings& settings, std::vector<RTCBuildPrimitive>& primitives, std::size_t count)
{
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = settings.extra_references > 0.0f ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = BVH_WIDTH;
    arguments.maxDepth = BVH_MAX_DEPTH;
    arguments.sahBlockSize = BVH_WIDTH;
    arguments.minLeafSize = settings.min_leaf_size;
    arguments.maxLeafSize = settings.max_leaf_size;
    arguments.traversalCost = settings.traversal_cost;
    arguments.intersectionCost = settings.intersection_cost;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = split_primitive;
    return arguments;
}

// Embree's tree of `primitives`, not empty, handed to `flatten`. geometry: what spatial splits cut.
template <class Flatten>
BvhTree build_tree(const std::vector<BvhPrimitive>& primitives, BvhGeometry geometry, const BvhSettings& settings, const Flatten& flatten)
{
    BvhTree tree;
    for (const BvhPrimitive& primitive : primitives) tree.bounds.extend(primitive.bounds);
    std::vector<RTCBuildPrimitive> references(primitives.size() +
                                              static_cast<std::size_t>(settings.extra_references * static_cast<float>(primitives.size())));
    std::transform(primitives.begin(), primitives.end(), references.begin(), to_embree);

    const std::unique_ptr<RTCDeviceTy, ReleaseDevice> device(rtcNewDevice(nullptr));
    if (!device) throw_build_error(nullptr, primitives.size());
    const std::unique_ptr<RTCBVHTy, ReleaseBvh> memory(rtcNewBVH(device.get()));
    if (!memory) throw_build_error(device.get(), primitives.size());
    RTCBuildArguments arguments = build_arguments(settings, references, primitives.size());
    arguments.bvh = memory.get();
    arguments.userPtr = &geometry;
    const void* root = rtcBuildBVH(&arguments);
    if (!root) throw_build_error(device.get(), primitives.size());
    tree.root = flatten(*static_cast<const BuildNode*>(root));
    return tree;
}

} // namespace

Bvh build_bvh(const BvhGeometry& geometry, const BvhSettings& settings)
{
    Bvh bvh;
    const BvhTree tree = append_tree(bvh, geometry, settings);
    bvh.root = tree.root;
    bvh.bounds = tree.bounds;
    return bvh;
}

BvhTree append_tree(Bvh& bvh, const BvhGeometry& geometry, const BvhSettings& settings)
{
    assert(settings.max_leaf_size >= 1 && settings.max_leaf_size <= BuildLeaf::capacity);
    const std::vector<BvhPrimitive> primitives = collect_primitives(geometry);
    if (primitives.empty()) return {};
    return build_tree(primitives, geometry, settings, [&](const BuildNode& root) { return flatten_tree(geometry, root, bvh); });
}

BvhTree append_instance_tree(Bvh& bvh, const std::vector<BvhPrimitive>& instances)
{
    if (instances.size() > BVH_MAX_INSTANCES)
        throw SceneError({}, "the scene has " + std::to_string(instances.size()) + " instances; at most " +
                                 std::to_string(BVH_MAX_INSTANCES) + " can be rendered");
    if (instances.empty()) return {};
    // An instance costs more than a node: each gets a leaf, that is, a box of its own.
    BvhSettings settings;
    settings.min_leaf_size = settings.max_leaf_size = 1;
    settings.intersection_cost = 4.0f;
    settings.extra_references = 0.0f;
    return build_tree(instances, {}, settings, [&](const BuildNode& root) { return flatten_instance_tree(root, bvh); });
}

} // namespace sundog
