// The host scene: plain data, what a scene file describes, already validated.
// Importers fill it; the acceleration build and the upload to the device read it.
// All colours are linear sRGB, all positions and directions world space, all
// angles radians.
#pragma once

#include "base/errors.h"
#include "math/animated_transform.h"
#include "math/bounds.h"
#include "math/double3.h"
#include "math/vec3.h"
#include "scene/dispersion.h"
#include "scene/shutter.h"
#include "shared/vec2.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
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
    Vec3 axis_x{1, 0, 0}; // of its texture coordinates, unit length
    Vec3 axis_y{0, 1, 0};
    Vec3 axis_z{0, 0, 1};
};

// centre + a * axis_u + b * axis_v, a^2 + b^2 <= 1; normal along axis_u x axis_v unless flipped.
struct Disk {
    Vec3 center;
    Vec3 axis_u;
    Vec3 axis_v;
    bool flip_normals = false;

    Vec3 normal() const; // unit length
};

// Open at both ends; normals away from the axis unless flipped. The axes are of unit length and orthogonal; x and y are
// those of its texture coordinates.
struct Cylinder {
    Vec3 start; // of the axis, which is along axis_z
    float radius = 1.0f;
    float length = 1.0f;
    bool flip_normals = false;
    Vec3 axis_x{1, 0, 0};
    Vec3 axis_y{0, 1, 0};
    Vec3 axis_z{0, 0, 1};
};

// --- Textures -----------------------------------------------------------------

// A value, or a texture (an index into Scene::textures) and a factor on it.
struct ColorSource {
    Vec3 value{1, 1, 1};
    std::optional<uint> texture;

    ColorSource() = default;
    ColorSource(Vec3 color) : value(color) {}
    ColorSource(float r, float g, float b) : value{r, g, b} {}
    ColorSource(Vec3 factor, uint index) : value(factor), texture(index) {}
};

// The same for a number; a texture counts by its luminance.
struct NumberSource {
    float value = 1.0f;
    std::optional<uint> texture;

    NumberSource() = default;
    NumberSource(float number) : value(number) {}
    NumberSource(float factor, uint index) : value(factor), texture(index) {}

    bool may_be_positive() const { return texture || value > 0.0f; }
};

enum class TexelFormat { srgb8, linear8, half, float32 }; // as TEXELS_... of kernels/shared/texture.h
enum class WrapMode { repeat, mirror, clamp, zero, one }; // zero and one: what is outside of the image
enum class TextureFilter { nearest, bilinear };

constexpr std::size_t words_per_texel(TexelFormat format)
{
    return format == TexelFormat::float32 ? 3 : format == TexelFormat::half ? 2 : 1;
}

// Rows from the top.
struct TexelImage {
    int width = 0;
    int height = 0;
    TexelFormat format = TexelFormat::srgb8;
    std::vector<uint> texels; // a texel's one (8 bits), two (half) or three (float) words

    std::size_t words_per_texel() const { return sundog::words_per_texel(format); }
};

struct BitmapTexture {
    std::shared_ptr<const TexelImage> image;
    WrapMode wrap_u = WrapMode::repeat;
    WrapMode wrap_v = WrapMode::repeat;
    TextureFilter filter = TextureFilter::bilinear;
};

struct CheckerboardTexture {
    ColorSource colors[2];
};

struct AttributeTexture {
    std::string name; // of a MeshAttribute; 0 where a shape has none
};

// What a texture's value, with the factor on it, is clamped to.
enum class TextureRange {
    any,
    positive, // 0 and more: light
    unit, // [0, 1]: reflectances
};

struct TextureDescription {
    std::string id;
    SourceLocation where;
    std::array<float, 3> to_u{1, 0, 0}; // u' = to_u . (u, v, 1)
    std::array<float, 3> to_v{0, 1, 0};
    std::variant<BitmapTexture, CheckerboardTexture, AttributeTexture> model;
    TextureRange range = TextureRange::any;

    double aspect() const; // of a bitmap, width over height; 1 for others
};

// --- Scattering ---------------------------------------------------------------

// Of microfacets: root mean square slope times sqrt(2), along the texture's u and v.
struct Roughness {
    bool beckmann = false; // else Trowbridge and Reitz (GGX)
    NumberSource alpha_u{0.0f};
    NumberSource alpha_v{0.0f};
};

struct DiffuseBsdf {
    ColorSource reflectance{0.5f, 0.5f, 0.5f};
};

struct DielectricBsdf {
    float int_ior = 1.5046f; // bk7
    float ext_ior = 1.000277f; // air
    bool thin = false;
    ColorSource specular_reflectance;
    ColorSource specular_transmittance;
    std::optional<Roughness> roughness = std::nullopt; // never of a thin one
    // Of the interior; int_ior is its index at the sodium D line. Shows in spectral transport.
    std::optional<SellmeierFormula> dispersion = std::nullopt;
};

// eta and k relative to the exterior medium. eta = 0 and k = 1 (material "none")
// is a perfect mirror.
struct ConductorBsdf {
    Vec3 eta{0, 0, 0};
    Vec3 k{1, 1, 1};
    ColorSource specular_reflectance;
    std::optional<Roughness> roughness = std::nullopt;
};

// A dielectric coat over a diffuse base.
struct PlasticBsdf {
    float int_ior = 1.49f;     // polypropylene
    float ext_ior = 1.000277f; // air
    ColorSource diffuse_reflectance{0.5f, 0.5f, 0.5f};
    ColorSource specular_reflectance;
    bool nonlinear = false;                            // colours deepen as light goes to and fro below the coat
    std::optional<Roughness> roughness = std::nullopt; // of the coat: isotropic, a number
};

// Disney's, with Mitsuba's parameters: each is between 0 and 1 (kernels/shared/principled.h says what it does).
struct PrincipledBsdf {
    ColorSource base_color{0.5f, 0.5f, 0.5f};
    NumberSource roughness{0.5f};
    NumberSource anisotropic{0.0f};
    NumberSource metallic{0.0f};
    NumberSource spec_trans{0.0f};
    float eta = 1.5f; // interior over exterior index
    NumberSource spec_tint{0.0f};
    NumberSource sheen{0.0f};
    NumberSource sheen_tint{0.0f};
    NumberSource flatness{0.0f};
    NumberSource clearcoat{0.0f};
    NumberSource clearcoat_gloss{0.0f};

    bool transmits() const { return spec_trans.may_be_positive(); }
};

// The modified Phong model [Lafortune and Willems 1994].
struct PhongBsdf {
    ColorSource diffuse_reflectance{0.5f, 0.5f, 0.5f};
    ColorSource specular_reflectance{0.2f, 0.2f, 0.2f};
    NumberSource exponent{30.0f};
};

// Another BSDF about a normal that a texture says: (x, y, z) + 1, halved, in the frame of u, v and the shading normal.
struct NormalMapBsdf {
    ColorSource normals{0.5f, 0.5f, 1.0f};
    bool flip_invalid = true; // turn round normals that face away from the viewer
    bool shadowing = true;    // darken what the relief would shadow
    uint nested = 0;          // index into Scene::bsdfs
};

// The same by heights (scene units): the normal of the surface that they would raise.
struct BumpMapBsdf {
    NumberSource heights{0.0f};
    bool flip_invalid = true;
    bool shadowing = true;
    uint nested = 0;
};

// A dielectric layer over another BSDF [Weidlich and Wilkie 2007]: one that is opaque and one-sided, and has no interface of
// its own.
struct CoatingBsdf {
    float int_ior = 1.5046f;   // bk7
    float ext_ior = 1.000277f; // air
    float thickness = 1.0f;    // in units of 1 / sigma_a
    ColorSource sigma_a{0, 0, 0}; // absorption within the layer
    ColorSource specular_reflectance;
    std::optional<Roughness> roughness = std::nullopt; // of the layer's surface: isotropic
    uint nested = 0; // index into Scene::bsdfs
};

struct NullBsdf {};

// `nested` where the mask is opaque, else nothing at all.
struct MaskBsdf {
    NumberSource opacity{0.5f};
    uint nested = 0; // index into Scene::bsdfs
};

struct BlendBsdf {
    NumberSource weight{0.5f}; // of the second
    uint nested[2] = {0, 0};
};

// Indices into Scene::bsdfs, neither of them a TwoSidedBsdf.
struct TwoSidedBsdf {
    uint front = 0;
    uint back = 0;
};

struct BsdfDescription {
    std::string id; // as in the file, may be empty
    SourceLocation where;
    std::variant<DiffuseBsdf, DielectricBsdf, ConductorBsdf, NullBsdf, TwoSidedBsdf, MaskBsdf, BlendBsdf, PlasticBsdf, NormalMapBsdf,
                 BumpMapBsdf, PrincipledBsdf, PhongBsdf, CoatingBsdf>
        model;
};

// --- Emitters -----------------------------------------------------------------

struct AreaEmitter {
    Vec3 radiance; // W/m^2/sr, from the normal's side
    std::optional<uint> texture = std::nullopt; // factor on the radiance: an index into Scene::textures
};

struct ShapeDescription {
    std::string id;
    SourceLocation where;
    std::variant<TriangleMesh, Sphere, Disk, Cylinder> geometry;
    uint bsdf = 0; // index into Scene::bsdfs
    std::optional<AreaEmitter> emitter;
    std::optional<uint> group = std::nullopt; // index into Scene::groups of the one it belongs to; else it lies in the world

    Bounds bounds() const; // in the space of its group, or the world
};

// Shapes that are seen only where an instance places a copy of them. They name their group; none of them emits light.
struct ShapeGroup {
    std::string id;
    SourceLocation where;
};

struct InstanceDescription {
    std::string id;
    SourceLocation where;
    uint group = 0; // index into Scene::groups
    AnimatedTransform to_world; // affine, nowhere singular
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
    std::optional<uint> texture = std::nullopt; // factor on the intensity; fills the square about the cone
    Vec3 axis_x{1, 0, 0}; // where the texture's u grows, unit length, orthogonal to the direction
    Vec3 axis_y{0, 1, 0}; // where its v grows: down its image
};

// An image thrown like a camera's picture in reverse.
struct ProjectorEmitter {
    Vec3 position;
    Vec3 axis_x{1, 0, 0}; // to the left of the image, unit length
    Vec3 axis_y{0, 1, 0}; // up
    Vec3 axis_z{0, 0, 1}; // of propagation
    float half_width = 1.0f; // of the image on a plane one unit away
    float half_height = 1.0f;
    Vec3 irradiance; // W/m^2 on that plane
    std::optional<uint> texture; // factor on it
};

struct DirectionalEmitter {
    Vec3 direction; // of propagation, unit length
    Vec3 irradiance; // W/m^2 across the direction
};

// All its light goes along one ray.
struct CollimatedEmitter {
    Vec3 position;
    Vec3 direction; // of propagation, unit length
    Vec3 power; // W
};

struct ConstantEmitter {
    Vec3 radiance; // W/m^2/sr
};

// A latitude-longitude image around the scene, in Mitsuba's orientation: its middle column is seen along axis_z, its
// first row along axis_y, columns to the right of the middle towards -axis_x.
struct EnvironmentEmitter {
    std::shared_ptr<const TexelImage> image; // float32, radiance (W/m^2/sr), nowhere negative
    float scale = 1.0f;
    Vec3 axis_x{1, 0, 0}; // unit length and orthogonal
    Vec3 axis_y{0, 1, 0};
    Vec3 axis_z{0, 0, 1};
};

// A clear sky and the sun's disk in it [Hosek and Wilkie 2012, 2013]; black below the horizon.
struct SunSkyEmitter {
    Vec3 up{0, 0, 1};            // unit length
    Vec3 sun_direction{0, 0, 1}; // towards the sun, not below the horizon; unit length
    float turbidity = 3.0f;      // 1 to 10
    Vec3 albedo{0.3f, 0.3f, 0.3f}; // of the ground: 0 to 1
    float sky_scale = 1.0f;
    float sun_scale = 1.0f;
    float sun_aperture = 0.5358f; // angle under which the sun is seen (degrees); its power stays the same
    bool limb_darkening = true;   // the sun is darker towards its rim; else its radiance is the mean
    float stretch = 1.0f;         // 1 to 2: angles to the zenith are this much wider, the horizon lies lower
    bool extend = false;          // the horizon's radiance below it, instead of black
};

struct EmitterDescription {
    SourceLocation where;
    std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, ConstantEmitter, EnvironmentEmitter, ProjectorEmitter, CollimatedEmitter, SunSkyEmitter> model;
};

// --- Sensor and film ------------------------------------------------------------

enum class Projection { perspective, orthographic };

struct Sensor {
    SourceLocation where;
    Projection projection = Projection::perspective;
    Vec3 position{0, 0, 0}; // of the lens; orthographic: where the axis meets the film
    Vec3 axis_x{1, 0, 0}; // unit length; +x points to the image's left, as in Mitsuba
    Vec3 axis_y{0, 1, 0};
    Vec3 axis_z{0, 0, 1}; // viewing direction
    float fov_x = 0.6911504f; // perspective: horizontal, of the full film (rad)
    float extent_x = 1.0f; // orthographic: half the width of the full film (scene units)
    float extent_y = 1.0f; // and half the height that it had if it were as many pixels high as wide
    float principal_offset_x = 0.0f; // from the film's centre to its left, in widths of the full film
    float principal_offset_y = 0.0f; // and up, in heights: the axis meets the film there
    float near_clip = 1e-2f; // along axis_z, as far_clip: nothing nearer shows or occludes
    float far_clip = 1e4f;
    float aperture_radius = 0.0f; // 0: pinhole
    float focus_distance = 0.0f; // along axis_z
    Shutter shutter;
    // Where the camera goes while the shutter is open, by poses (orthonormal); the position and axes above are those
    // where it opens. Nothing: it stands still.
    std::optional<AnimatedTransform> motion = std::nullopt;
};

enum class FilterKind { box, tent, gaussian, mitchell, lanczos };

struct ReconstructionFilter {
    FilterKind kind = FilterKind::gaussian;
    float radius = 2.0f; // pixels
    float stddev = 0.5f; // gaussian
    float b = 1.0f / 3.0f; // mitchell
    float c = 1.0f / 3.0f;
    // lanczos: its radius is its number of lobes
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
    bool hide_emitters = false; // from what sees them straight from the camera
    int sample_count = 0; // of <sampler>; 0 without one
    std::uint64_t seed = 0;
};

struct Scene {
    std::string file;
    Double3 origin{0, 0, 0}; // where the world's is in the file: not 0 in a scene that is far away in its file
    std::vector<TextureDescription> textures;
    std::vector<BsdfDescription> bsdfs;
    std::vector<ShapeDescription> shapes; // of the world and of groups
    std::vector<ShapeGroup> groups;
    std::vector<InstanceDescription> instances;
    std::vector<EmitterDescription> emitters; // all but area emitters
    Sensor sensor;
    Film film;
    IntegratorRequest integrator;

    std::size_t triangle_count() const; // as stored: those of groups once
    std::size_t triangle_count_with_copies() const; // as seen
    Bounds bounds() const; // of all that is seen while the shutter is open; around instances not tight
    bool has_dispersion() const;
    bool moves() const; // whether camera or instances do while the shutter is open
};

} // namespace sundog
