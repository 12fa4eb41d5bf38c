#include "scene/scene_bvh.h"

#include "base/errors.h"
#include "scene/bvh_flatten.h"
#include "scene/bvh_primitives.h"
#include "shared/ray.h"

#include <algorithm>
#include <cmath>

namespace sundog
{
namespace
{

// A ray moved into a group's space is off by a few roundings of the distances involved (5 for the origin, 4 for the
// direction, 2 for the matrices), and its tests there report what is up to 24 off (SLAB_ERROR of bvh_traverse.h). Such a
// shift is the same for a whole group, so that it opens no gaps; a box without room for it would cut off outlines.
constexpr double transform_error = 36.0 / 16777216.0;

BvhTree append_range(Bvh& bvh, const FlatScene& flat, const PrimitiveRange& range)
{
    const std::size_t first_block = bvh.blocks.size();
    const BvhTree tree = append_tree(bvh, {flat.positions, std::span(flat.triangles).subspan(range.first_triangle, range.triangle_count),
                                           std::span(flat.analytics).subspan(range.first_analytic, range.analytic_count)});
    // From numbers within the range to those of the scene.
    for (std::size_t i = first_block; i < bvh.blocks.size(); i++)
        for (uint& id : bvh.blocks[i].id)
            if (id != NO_PRIMITIVE) id += id & ANALYTIC_BIT ? range.first_analytic : range.first_triangle;
    return tree;
}

// The boxes that a ray meets first in a tree: tighter together, once turned, than one box.
std::vector<Bounds> topmost_boxes(const Bvh& bvh, const BvhTree& tree)
{
    if (tree.root < 0) return {tree.bounds};
    std::vector<Bounds> boxes;
    const BvhNode& node = bvh.nodes[static_cast<std::size_t>(tree.root)];
    for (int i = 0; i < BVH_WIDTH; i++)
        if (node.child[i] != ~0)
            boxes.push_back({{node.lower_x[i], node.lower_y[i], node.lower_z[i]}, {node.upper_x[i], node.upper_y[i], node.upper_z[i]}});
    return boxes;
}

double magnitude(Vec3 v)
{
    return std::abs(static_cast<double>(v.x)) + std::abs(static_cast<double>(v.y)) + std::abs(static_cast<double>(v.z));
}

// The largest row sum of |to_world| |to_object|: by how much a rounding error grows on its way there and back.
double error_growth(const Instance& instance)
{
    double largest = 1.0;
    for (const Vec3& row : instance.to_world)
        largest = std::max(largest, std::abs(static_cast<double>(row.x)) * magnitude(instance.to_object[0]) +
                                        std::abs(static_cast<double>(row.y)) * magnitude(instance.to_object[1]) +
                                        std::abs(static_cast<double>(row.z)) * magnitude(instance.to_object[2]));
    return largest;
}

Vec3 to_world(const Instance& instance, Vec3 p)
{
    const auto along = [&](Vec3 row, float offset) {
        return static_cast<float>(static_cast<double>(row.x) * p.x + static_cast<double>(row.y) * p.y + static_cast<double>(row.z) * p.z +
                                  offset);
    };
    return {along(instance.to_world[0], instance.translation.x), along(instance.to_world[1], instance.translation.y),
            along(instance.to_world[2], instance.translation.z)};
}

// Where the instance is, with room for the rounding of rays that start within the scene's sphere.
Bounds box_of(const Instance& instance, const std::vector<Bounds>& boxes, float scene_radius)
{
    Bounds all;
    for (const Bounds& b : boxes)
        for (unsigned corner = 0; corner < 8; corner++)
            all.extend(to_world(
                instance, {corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y, corner & 4 ? b.upper.z : b.lower.z}));
    const double distance = 2.0 * scene_radius + magnitude(all.center() - instance.translation) + 0.5 * magnitude(all.extent());
    const double coordinates = std::max(magnitude(all.lower), magnitude(all.upper));
    const auto room = static_cast<float>(transform_error * error_growth(instance) * distance + 0x1p-22 * coordinates);
    return {all.lower - Vec3{room, room, room}, all.upper + Vec3{room, room, room}};
}

// The same at all times that the shutter is open. The tree is built once, about where instances are at any time: rays then
// look in vain where one is at another time, which costs the test of a group's first node. Distances from its translation
// are at most `stretch` times those in its group; |to_world| |to_object| has a row sum of at most three times the product
// of both norms, since |A|_inf <= sqrt(3) |A|_2.
Bounds box_of(const AnimatedTransform& motion, const Shutter& shutter, const std::vector<Bounds>& boxes, float scene_radius)
{
    Bounds all;
    double reach = 0.0;
    for (const Bounds& b : boxes) {
        all.extend(motion.box(b, shutter.open, shutter.close));
        reach = std::max(reach, std::max(magnitude(b.lower), magnitude(b.upper)));
    }
    const double distance = 2.0 * scene_radius + std::sqrt(3.0) * motion.stretch() * reach;
    const double growth = 3.0 * motion.stretch() * motion.inverse_stretch();
    const double coordinates = std::max(magnitude(all.lower), magnitude(all.upper));
    const auto room = static_cast<float>(transform_error * growth * distance + 0x1p-22 * coordinates);
    return {all.lower - Vec3{room, room, room}, all.upper + Vec3{room, room, room}};
}

void check_range(const Bounds& box, std::size_t instance)
{
    constexpr float largest = 1e12f;
    for (const Vec3& v : {box.lower, box.upper})
        if (!(std::abs(v.x) <= largest && std::abs(v.y) <= largest && std::abs(v.z) <= largest)) // so that a NaN is refused
            throw SceneError({}, "instance " + std::to_string(instance) + " reaches to a coordinate beyond 1e12; check its transform");
}

// The tree of instances, with those of their groups.
BvhTree append_instances(Bvh& bvh, const FlatScene& flat)
{
    if (flat.instances.empty()) return {};
    std::vector<BvhTree> groups;
    std::vector<std::vector<Bounds>> group_boxes;
    for (const PrimitiveRange& range : flat.groups) {
        groups.push_back(append_range(bvh, flat, range));
        group_boxes.push_back(groups.back().bounds.empty() ? std::vector<Bounds>{} : topmost_boxes(bvh, groups.back()));
    }
    bvh.instances = flat.instances;
    std::vector<const AnimatedTransform*> motions(flat.instances.size());
    for (const InstanceMotion& motion : flat.instance_motions) motions[motion.instance] = &motion.to_world;
    std::vector<BvhPrimitive> seen; // those of groups that are not empty
    for (std::size_t i = 0; i < flat.instances.size(); i++) {
        Instance& instance = bvh.instances[i];
        const BvhTree& group = groups[flat.instance_groups[i]];
        instance.root = group.root;
        if (group.bounds.empty()) continue;
        instance.center = group.bounds.center();
        instance.radius = group.bounds.radius();
        const std::vector<Bounds>& boxes = group_boxes[flat.instance_groups[i]];
        const Bounds box =
            motions[i] ? box_of(*motions[i], flat.shutter, boxes, flat.globals.radius) : box_of(instance, boxes, flat.globals.radius);
        check_range(box, i);
        bvh.bounds.extend(box);
        seen.push_back({box, static_cast<uint>(i)});
    }
    return append_instance_tree(bvh, seen);
}

BvhTree joined(const BvhTree& first, const BvhTree& second, Bvh& bvh)
{
    BvhTree tree;
    tree.root = join_trees(first.root, first.bounds, second.root, second.bounds, bvh);
    tree.bounds = first.bounds;
    tree.bounds.extend(second.bounds);
    return tree;
}

} // namespace

Bvh build_scene_bvh(const FlatScene& flat)
{
    Bvh bvh;
    const BvhTree world = append_range(bvh, flat, flat.world);
    bvh.bounds = world.bounds;
    const BvhTree instances = append_instances(bvh, flat);
    BvhTree tree = instances.bounds.empty() ? world : world.bounds.empty() ? instances : joined(world, instances, bvh);
    if (flat.hides_emitters) { // the first child of the root is what the camera sees
        const BvhTree hidden = append_range(bvh, flat, flat.hidden);
        bvh.bounds.extend(hidden.bounds);
        tree = joined(tree, hidden, bvh);
    }
    bvh.root = tree.root;
    return bvh;
}

} // namespace sundog
