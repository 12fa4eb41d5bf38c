// The hierarchy of a whole scene: the world's own tree, one tree a group, and above them the instances.
#pragma once

#include "scene/bvh_build.h"
#include "scene/flat_scene.h"

namespace sundog
{

// One tree, as build_bvh's, for a scene without instances. Else two levels: the root chooses between the world's own
// primitives and the tree of instances, each a leaf; bvh.instances names the root of each one's group. Groups share
// the arrays of nodes and blocks. The boxes of instances that move hold them at any time that the shutter is open; root,
// center and radius of an Instance do not change with its place. Where emitters are hidden the root's first child holds all but
// the lights, its second the lights. Throws as build_bvh.
Bvh build_scene_bvh(const FlatScene& flat);

} // namespace sundog
