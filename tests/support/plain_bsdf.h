// Scattering in double precision, from the materials that a scene describes rather than from their device records.
#pragma once

#include "support/plain_sampling.h"
#include "support/plain_surface.h"

#include <complex>
#include <optional>
#include <variant>

namespace sundog
{

// Fresnel's equations for unpolarised light from a medium of index 1 to one of index n, which is complex for metals.
// Under total internal reflection the root is imaginary, and both amplitudes have modulus 1.
inline double fresnel_reflectance(double cos_i, std::complex<double> n)
{
    const double sin2 = 1.0 - cos_i * cos_i;
    const std::complex<double> root = std::sqrt(n * n - sin2);
    return 0.5 * (std::norm((cos_i - root) / (cos_i + root)) + std::norm((n * n * cos_i - root) / (n * n * cos_i + root)));
}

// A pane reflects at its front, and after each pair of passages once more: R + T^2 R (1 + R^2 + R^4 + ...).
inline double pane_reflectance(double cos_i, double n)
{
    const double r = fresnel_reflectance(cos_i, n), t = 1.0 - r;
    return t > 0.0 ? r + t * t * r / (1.0 - r * r) : 1.0;
}

// What scatters on the side that a ray sees.
struct PlainSide {
    const BsdfDescription* bsdf;
    Vec3d normal; // on the front of `bsdf`
    double cos_o; // negative: seen from behind

    template <class Model> const Model* as() const { return std::get_if<Model>(&bsdf->model); }
    bool specular() const { return !as<DiffuseBsdf>(); }
    bool black() const { return cos_o <= 0.0 && (as<DiffuseBsdf>() || as<ConductorBsdf>()); } // one-sided, from behind
};

inline PlainSide plain_side(const PlainScene& scene, const PlainSurface& surface)
{
    const auto& bsdfs = scene.scene.bsdfs;
    const BsdfDescription* bsdf = &bsdfs[scene.scene.shapes[surface.shape].bsdf];
    const double cos_o = dot(surface.outgoing, surface.shading_normal);
    if (const auto* sides = std::get_if<TwoSidedBsdf>(&bsdf->model)) {
        if (cos_o < 0.0) return {&bsdfs[sides->back], -surface.shading_normal, -cos_o};
        bsdf = &bsdfs[sides->front];
    }
    return {bsdf, surface.shading_normal, cos_o};
}

// Both directions on the front of the shading normal, and on one side of the surface itself.
inline bool reflects(const PlainSide& side, const PlainSurface& surface, Vec3d direction, Doubt& doubt)
{
    const bool front = doubt.positive(dot(direction, side.normal)) && side.cos_o > 0.0;
    return front && doubt.positive(dot(direction, surface.normal_seen()));
}

// f (1/sr) for light from `direction`.
inline Vec3d plain_evaluate(const PlainSide& side, const PlainSurface& surface, Vec3d direction, Doubt& doubt)
{
    const auto* diffuse = side.as<DiffuseBsdf>();
    return diffuse && reflects(side, surface, direction, doubt) ? Vec3d(diffuse->reflectance.value) / pi : Vec3d();
}

// Of plain_scatter, 1/sr.
inline double plain_pdf_w(const PlainSide& side, Vec3d direction)
{
    return side.specular() ? 0.0 : std::max(0.0, dot(direction, side.normal)) / pi;
}

struct PlainScatter {
    Vec3d direction;
    Vec3d weight;             // f |cos| / pdf_w for radiance, without its compression by refraction
    double pdf_w = 0.0;       // 0: specular
    double eta_squared = 1.0; // of the index beyond over the index before
    bool transmitted = false;
};

inline Vec3d mirrored(Vec3d o, Vec3d n)
{
    return n * (2.0 * dot(o, n)) - o;
}

// Snell: the component along the surface shrinks by the index. n on the side of o; nothing under total reflection.
inline std::optional<Vec3d> refracted(Vec3d o, Vec3d n, double index)
{
    const Vec3d along = (n * dot(o, n) - o) / index;
    const double rest = 1.0 - dot(along, along);
    if (rest < 0.0) return {};
    return along - n * std::sqrt(rest);
}

inline PlainScatter scatter_by(const DiffuseBsdf& diffuse, const PlainSide& side, Vec3d, const ScatterNumbers& u, Doubt& doubt)
{
    const Vec3d local = plain_cosine_hemisphere(u.direction, doubt);
    return {PlainFrame(side.normal, doubt).to_world(local), diffuse.reflectance.value, local.z / pi};
}

inline PlainScatter scatter_by(const DielectricBsdf& glass, const PlainSide& side, Vec3d o, const ScatterNumbers& u, Doubt& doubt)
{
    const double interior = double(glass.int_ior) / double(glass.ext_ior);
    const bool from_outside = side.cos_o > 0.0;
    const Vec3d n = from_outside ? side.normal : -side.normal;
    const double index = from_outside || glass.thin ? interior : 1.0 / interior;
    const double cos_o = std::abs(side.cos_o);
    const double reflectance = glass.thin ? pane_reflectance(cos_o, index) : fresnel_reflectance(cos_o, index);
    PlainScatter scatter{mirrored(o, n), glass.specular_reflectance.value};
    const double beyond = 1.0 - (1.0 - cos_o * cos_o) / (index * index); // cos^2 of the refracted ray
    if (!glass.thin) doubt.rests_on(beyond, 1e-3);                       // next to total reflection
    if (doubt.less(u.lobe, reflectance)) return scatter;
    scatter.transmitted = true;
    scatter.weight = glass.specular_transmittance.value;
    scatter.direction = -o;
    if (glass.thin) return scatter;
    scatter.direction = refracted(o, n, index).value_or(-o);
    scatter.eta_squared = index * index;
    return scatter;
}

inline PlainScatter scatter_by(const ConductorBsdf& metal, const PlainSide& side, Vec3d o, const ScatterNumbers&, Doubt&)
{
    const auto reflectance = [&](float eta, float k) { return fresnel_reflectance(side.cos_o, {double(eta), double(k)}); };
    const Vec3d fresnel(reflectance(metal.eta.x, metal.k.x), reflectance(metal.eta.y, metal.k.y), reflectance(metal.eta.z, metal.k.z));
    return {mirrored(o, side.normal), fresnel * Vec3d(metal.specular_reflectance.value)};
}

inline PlainScatter scatter_by(const NullBsdf&, const PlainSide&, Vec3d o, const ScatterNumbers&, Doubt&)
{
    return {.direction = -o, .weight = Vec3d(1, 1, 1), .transmitted = true};
}

template <class Mixture> PlainScatter scatter_by(const Mixture&, const PlainSide&, Vec3d, const ScatterNumbers&, Doubt&)
{
    throw std::logic_error("two-sided BSDFs and mixtures are not scattered by themselves");
}

// Where a path goes on; nothing where it is absorbed: behind a one-sided surface, and where an interpolated normal would
// send what is reflected through the face, or what is transmitted back from it.
inline std::optional<PlainScatter> plain_scatter(const PlainSide& side, const PlainSurface& surface, const ScatterNumbers& u, Doubt& doubt)
{
    if (side.black()) return {};
    const PlainScatter scatter =
        std::visit([&](const auto& model) { return scatter_by(model, side, surface.outgoing, u, doubt); }, side.bsdf->model);
    const bool same_side = doubt.positive(dot(scatter.direction, surface.normal_seen()));
    if (same_side == scatter.transmitted) return {};
    return scatter;
}

} // namespace sundog
