// The scene on the device, named once: this list becomes the kernels' parameters
// (kernels/scene/scene_view.h) and the host's buffers (src/stages/scene_upload.h).
#ifndef SUNDOG_SHARED_SCENE_ARRAYS_H
#define SUNDOG_SHARED_SCENE_ARRAYS_H
#include "shared/bsdf.h"
#include "shared/bvh.h"
#include "shared/environment.h"
#include "shared/geometry.h"
#include "shared/light.h"
#include "shared/light_tree.h"
#include "shared/principled.h"
#include "shared/ray.h"
#include "shared/texture.h"
#include "shared/vec2.h"
#include "shared/wavelengths.h"
SHARED_BEGIN

typedef struct SceneGlobals {
    Vec3 center; // of the bounding sphere of all geometry
    float radius;
    uint light_count;
    uint environment_light; // index of the constant or mapped environment, or NO_LIGHT
    int bvh_root;        // as BvhNode::child
    uint attribute_count; // distinct names of mesh attributes; attribute_ranges has so many a shape
    Wavelengths wavelengths; // of the pass, in spectral transport
} SceneGlobals;
SHARED_SIZE(SceneGlobals, 160);

// X(element type, array name). One SceneGlobals, `globals`, stands before the lists.
#define GEOMETRY_ARRAYS(X)                                                                         \
    X(BvhNode, bvh_nodes)                                                                          \
    X(BvhBlock, bvh_blocks)                                                                        \
    X(AnalyticPrimitive, analytics)                                                                \
    X(Instance, instances)

#define SURFACE_ARRAYS(X)                                                                          \
    X(Triangle, triangles)                                                                         \
    X(Vec3, positions)                                                                             \
    X(Vec3, normals)                                                                               \
    X(Vec2, uvs)                                                                                   \
    X(AttributeRange, attribute_ranges)                                                            \
    X(Vec3, attribute_values)                                                                      \
    X(Texture, textures)                                                                           \
    X(uint, texels)                                                                                \
    X(Shape, shapes)                                                                               \
    X(Bsdf, bsdfs)                                                                                 \
    X(Principled, principled)                                                                      \
    X(Light, lights)                                                                               \
    X(AliasEntry, light_alias)                                                                     \
    X(LightNode, light_tree)                                                                       \
    X(LightProjection, light_projections)                                                          \
    X(EnvironmentMap, environment_maps)                                                            \
    X(AliasEntry, environment_alias)

SHARED_END
#endif
