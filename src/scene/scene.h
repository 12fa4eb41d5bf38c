// The host scene: plain data, what a scene file describes, already validated.
// Importers fill it; the acceleration build and the upload to the device read it.
// All colours are linear sRGB, all positions and directions world space, all
// angles radians.
#pragma once

#include "base/errors.h"
#include "math/bounds.h"
#include "math/vec3.h"
#include "shared/vec2.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sundog {

// --- Surfaces -----------------------------------------------------------------

// Colours (linear sRGB) or numbers (three times the same) that a mesh file gives, for textures of type mesh_attribute.
struct MeshAttribute {
    std::string name; // "vertex_color", "face_color", ...
    bool per_face = false; // one value a triangle; else one a position
    std::vector<Vec3> values;
};

struct TriangleMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals; // empty, or one a position (unit length)
    std::vector<Vec2> uvs{}; // texture coordinates: empty, or one a position
    std::vector<std::array<uint, 3>> triangles; // counter-clockwise seen from the normal's side
    std::vector<MeshAttribute> attributes{};
};

struct Sphere {
    Vec3 center;
    float radius = 1.0f;
    bool flip_normals = false;
};

// centre + a * axis_u + b * axis_v, a^2 + b^2 <= 1; normal along axis_u x axis_v.
struct Disk {
    Vec3 center;
    Vec3 axis_u;
    Vec3 axis_v;
};

// --- Scattering ---------------------------------------------------------------

struct DiffuseBsdf {
    Vec3 reflectance{0.5f, 0.5f, 0.5f};
};

struct DielectricBsdf {
    float int_ior = 1.5046f; // bk7
    float ext_ior = 1.000277f; // air
    bool thin = false;
    Vec3 specular_reflectance{1, 1, 1};
    Vec3 specular_transmittance{1, 1, 1};
};

// eta and k relative to the exterior medium. eta = 0 and k = 1 (material "none")
// is a perfect mirror.
struct ConductorBsdf {
    Vec3 eta{0, 0, 0};
    Vec3 k{1, 1, 1};
    Vec3 specular_reflectance{1, 1, 1};
};

struct NullBsdf {};

// Indices into Scene::bsdfs, neither of them a TwoSidedBsdf.
struct TwoSidedBsdf {
    uint front = 0;
    uint back = 0;
};

struct BsdfDescription {
    std::string id; // as in the file, may be empty
    SourceLocation where;
    std::variant<DiffuseBsdf, DielectricBsdf, ConductorBsdf, NullBsdf, TwoSidedBsdf> model;
};

// --- Emitters -----------------------------------------------------------------

struct AreaEmitter {
    Vec3 radiance; // W/m^2/sr, from the normal's side
};

struct ShapeDescription {
    std::string id;
    SourceLocation where;
    std::variant<TriangleMesh, Sphere, Disk> geometry;
    uint bsdf = 0; // index into Scene::bsdfs
    std::optional<AreaEmitter> emitter;
};

struct PointEmitter {
    Vec3 position;
    Vec3 intensity; // W/sr
};

struct SpotEmitter {
    Vec3 position;
    Vec3 direction; // of propagation, unit length
    Vec3 intensity; // on the axis, W/sr
    float cutoff_angle; // rad
    float beam_width; // rad, <= cutoff_angle; linear fall-off in angle between the two
};

struct DirectionalEmitter {
    Vec3 direction; // of propagation, unit length
    Vec3 irradiance; // W/m^2 across the direction
};

struct ConstantEmitter {
    Vec3 radiance; // W/m^2/sr
};

struct EmitterDescription {
    SourceLocation where;
    std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, ConstantEmitter> model;
};

// --- Sensor and film ------------------------------------------------------------

struct Sensor {
    SourceLocation where;
    Vec3 position{0, 0, 0};
    Vec3 axis_x{1, 0, 0}; // unit length; +x points to the image's left, as in Mitsuba
    Vec3 axis_y{0, 1, 0};
    Vec3 axis_z{0, 0, 1}; // viewing direction
    float fov_x = 0.6911504f; // horizontal, of the full film (rad)
    float near_clip = 1e-2f;
    float far_clip = 1e4f;
    float aperture_radius = 0.0f; // 0: pinhole
    float focus_distance = 0.0f; // along axis_z
};

enum class FilterKind { box, tent, gaussian, mitchell };

struct ReconstructionFilter {
    FilterKind kind = FilterKind::gaussian;
    float radius = 2.0f; // pixels
    float stddev = 0.5f; // gaussian
    float b = 1.0f / 3.0f; // mitchell
    float c = 1.0f / 3.0f;
};

struct Film {
    SourceLocation where;
    int width = 768;
    int height = 576;
    int crop_x = 0;
    int crop_y = 0;
    int crop_width = 768; // == width, height without a crop
    int crop_height = 576;
    ReconstructionFilter filter;
};

// --- What the scene asks of the renderer --------------------------------------------

// One parameter of <integrator>, kept as text: the method that will read it knows its type.
struct ParameterText {
    std::string value;
    SourceLocation where;
};

struct IntegratorRequest {
    SourceLocation where;
    std::string method; // as in the file; empty without <integrator>
    std::map<std::string, ParameterText> parameters; // names in snake_case
    int sample_count = 0; // of <sampler>; 0 without one
    std::uint64_t seed = 0;
};

struct Scene {
    std::string file;
    std::vector<BsdfDescription> bsdfs;
    std::vector<ShapeDescription> shapes;
    std::vector<EmitterDescription> emitters; // all but area emitters
    Sensor sensor;
    Film film;
    IntegratorRequest integrator;

    std::size_t triangle_count() const;
    Bounds bounds() const;
};

} // namespace sundog
