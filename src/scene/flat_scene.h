// The scene as the device's arrays: shapes flattened, lights listed, probabilities tabulated.
#pragma once

#include "scene/scene.h"
#include "shared/camera.h"
#include "shared/scene_arrays.h"

#include <vector>

namespace sundog {

// Consecutive primitives: those of the world, or of one group.
struct PrimitiveRange {
    uint first_triangle = 0;
    uint triangle_count = 0;
    uint first_analytic = 0;
    uint analytic_count = 0;
};

// An instance that moves while the shutter is open.
struct InstanceMotion {
    uint instance = 0; // index into FlatScene::instances
    AnimatedTransform to_world;
};

struct FlatScene {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals; // one a position when any shape has them, else empty
    std::vector<Vec2> uvs; // one a position when any shape has them, else empty
    std::vector<AttributeRange> attribute_ranges; // globals.attribute_count a shape
    std::vector<Vec3> attribute_values;
    std::vector<Texture> textures;
    std::vector<uint> texels;
    std::vector<Triangle> triangles;
    std::vector<AnalyticPrimitive> analytics;
    PrimitiveRange world; // the first primitives; those of the lights that the camera passes follow, then the groups', one by one
    bool hides_emitters = false;
    PrimitiveRange hidden; // where emitters are hidden, those of the lights
    std::vector<PrimitiveRange> groups;
    std::vector<Instance> instances; // all but root, center and radius, which follow from the hierarchy
    std::vector<uint> instance_groups; // index into groups, one an instance
    std::vector<InstanceMotion> instance_motions; // of those that move; instances has where they are when the shutter opens
    std::optional<AnimatedTransform> sensor_motion; // if the camera moves
    Shutter shutter;
    std::vector<Shape> shapes;
    std::vector<Bsdf> bsdfs;
    std::vector<Principled> principled; // parameters of those BSDFs that are
    std::vector<Light> lights;
    std::vector<float> light_strengths; // one a light: the greatest component of its emission, in the mean over its texture
    std::vector<AliasEntry> light_alias; // one a light
    std::vector<LightNode> light_tree; // empty where lights are chosen by power: light_tree.h fills it
    std::vector<LightProjection> light_projections;
    std::vector<EnvironmentMap> environment_maps; // at most one
    std::vector<AliasEntry> environment_alias; // one a patch
    SceneGlobals globals{}; // all but bvh_root
};

// Throws SceneError when no light has any power, or textures are larger than what 32 bits can address.
FlatScene flatten_scene(const Scene& scene);

// Gives the instance its matrices. Numbers beyond 32 bits become infinities.
void place(const Transform& to_world, Instance& instance);

// Whether paths may start at a light that none can hit: points and directions.
bool has_delta_lights(const FlatScene& flat);

// Whether light may arrive that neither next-event estimation nor a diffuse surface brings: focused by a lobe that is not as
// broad as a diffuse one, or collimated.
bool has_focused_light(const FlatScene& flat);

// Bit t is set where there are lights of type t: what kernels are specialised for.
uint light_types(const FlatScene& flat);

// Whether kernels need texture coordinates: for textures and anisotropic lobes.
bool needs_texture_coordinates(const FlatScene& flat);

// Vose's alias method for the given non-negative weights, of which at least one is positive; also gives each
// column's normalised probability. [Vose 1991, IEEE TSE 17(9)]
std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights, std::vector<float>& probabilities);

Camera make_camera(const Sensor& sensor, const Film& film);

// Tabulates the film's reconstruction filter for sampling.
PixelFilter make_pixel_filter(const ReconstructionFilter& filter);

} // namespace sundog
