// What one vertex of a path must do, in double precision: the reference for the shading stages.
#pragma once

#include "shared/path.h"
#include "shared/photon.h"
#include "support/plain_camera.h"
#include "support/plain_lights.h"

namespace sundog
{

// --- From vertex to vertex --------------------------------------------------------------------------------

struct PlainStep {
    PlainRay ray;
    Vec3d throughput;
    double pdf_w;
    uint depth;
    uint scattered;
    double eta_scale;
};

inline PlainStep plain_step(const PathState& path, const PlainSurface& surface, const PlainScatter& scatter, Vec3d throughput)
{
    return {surface.ray(scatter.direction),      throughput, scatter.pdf_w, path.depth + 1, path.scattered + (scatter.pdf_w > 0.0 ? 1 : 0),
            path.eta_scale * scatter.eta_squared};
}

// Radiance gets denser by the squared index where it enters a medium, so looking from there the path's throughput is
// divided by it. Roulette by the throughput that is left, that factor aside, and never above 0.95.
inline std::optional<PlainStep> plain_camera_step(const PathState& path, const PlainSurface& surface, const PlainSide& side,
                                                  const PathRules& rules, const ScatterNumbers& u, Doubt& doubt)
{
    const auto scatter = plain_scatter(side, surface, u, doubt);
    if (!scatter) return {};
    Vec3d throughput = Vec3d(path.throughput) * scatter->weight / scatter->eta_squared;
    if (path.depth >= rules.rr_depth) {
        const Vec3d size(std::abs(throughput.x), std::abs(throughput.y), std::abs(throughput.z));
        const double survival = std::min(0.95, largest(size) * path.eta_scale * scatter->eta_squared);
        if (!doubt.less(u.survival, survival)) return {};
        throughput = throughput / survival;
    }
    if (is_black(throughput)) return {};
    return plain_step(path, surface, *scatter, throughput);
}

// Flux is not changed by refraction. The adjoint BSDF, [Veach 1997, section 5.3.2]: flux arrives per area of the surface
// itself and leaves about it, while f's cosine is about the shading normal. Roulette by the share of flux that is left.
inline std::optional<PlainStep> plain_light_step(const PathState& path, const PlainSurface& surface, const PlainSide& side,
                                                 const PathRules& rules, const ScatterNumbers& u, Doubt& doubt)
{
    const auto scatter = plain_scatter(side, surface, u, doubt);
    if (!scatter) return {};
    const auto cosine = [&](Vec3d direction, Vec3d normal) {
        const double c = std::abs(dot(direction, normal));
        doubt.rests_on(c, 1e-2);
        return c;
    };
    const double arriving = cosine(surface.outgoing, surface.shading_normal) / cosine(surface.outgoing, surface.geometric_normal);
    const double leaving = cosine(scatter->direction, surface.geometric_normal) / cosine(scatter->direction, surface.shading_normal);
    const Vec3d before = path.throughput;
    Vec3d flux = before * scatter->weight * (arriving * leaving);
    if (path.depth >= rules.rr_depth) {
        const double survival = std::min(1.0, largest(flux) / largest(before));
        if (!doubt.less(u.survival, survival)) return {};
        flux = flux / survival;
    }
    if (is_black(flux)) return {};
    return plain_step(path, surface, *scatter, flux);
}

// --- Light ----------------------------------------------------------------------------------------------------

struct PlainShadow {
    PlainRay ray;
    Vec3d value; // what it brings if it is free: radiance times throughput, or a splat
    uint light_type = 0;
};

// f |cos| L / pdf. With `mis`: weighed by the balance heuristic [Veach 1997, section 9.2.2] against BSDF sampling, which
// finds extended lights only.
inline std::optional<PlainShadow> plain_direct_light(const PlainScene& scene, const PlainSurface& surface, const PlainSide& side,
                                                     const LightNumbers& u, bool mis, Doubt& doubt)
{
    const auto arrival = plain_arrival(scene.flat, surface, u, doubt);
    if (!arrival) return {};
    const Vec3d f = plain_evaluate(side, surface, arrival->direction, doubt);
    if (is_black(f)) return {};
    const double cosine = dot(arrival->direction, side.normal);
    doubt.rests_on(cosine, 1e-2);
    double weight = 1.0;
    if (mis && arrival->pdf_w > 0.0) weight = arrival->pdf_w / (arrival->pdf_w + plain_pdf_w(side, arrival->direction));
    return PlainShadow{arrival->shadow_ray, f * arrival->radiance * (cosine * weight), arrival->type};
}

// Radiance that a hit or a miss brings straight from a light, without the path's throughput. `pdf_w` of the path's last
// scattering, 0 for one that no light sampling competes with.
inline Vec3d plain_emitted(const PlainScene& scene, const PlainSurface* surface, Vec3d origin, double pdf_w, Doubt& doubt)
{
    const Light* light = surface ? plain_light_at(scene, *surface) : plain_environment(scene);
    if (!light) return {};
    double weight = 1.0;
    if (pdf_w > 0.0) {
        const double light_pdf_w =
            surface ? plain_light_pdf_w(scene.flat, *light, *surface, origin, doubt) : double(light->probability) / (4.0 * pi);
        weight = pdf_w / (pdf_w + light_pdf_w);
    }
    return Vec3d(light->emission) * weight;
}

inline bool is_bounded(const PathRules& rules)
{
    return rules.max_depth != UNBOUNDED_DEPTH;
}

// Whether a path of so many edges may still be counted.
inline bool allows(const PathRules& rules, uint edges)
{
    return !is_bounded(rules) || edges <= rules.max_depth;
}

// --- Stages -----------------------------------------------------------------------------------------------------

// What a vertex sees of its path.
struct PlainVertex {
    Ray ray;
    Hit hit;
    PathState path;
    bool missed() const { return hit.primitive == NO_PRIMITIVE; }
};

struct PlainOutcome {
    Vec3d radiance; // added to the path's pixel
    Vec3d flux;     // of the photon
    std::optional<PlainShadow> shadow;
    std::optional<PlainStep> next;
    std::optional<PlainSurface> surface;
    std::optional<PlainSide> side;
    bool leaves_record = false; // a query, a photon
};

// What all camera paths do: count what their ray brings. The rest follows where another edge is allowed.
inline bool start_camera_vertex(const PlainScene& scene, const PlainVertex& vertex, const PathRules& rules, double pdf_w,
                                PlainOutcome& outcome, Doubt& doubt)
{
    if (!allows(rules, vertex.path.depth)) return false;
    if (!vertex.missed()) {
        outcome.surface = plain_surface(scene.flat, vertex.ray, vertex.hit, doubt);
        outcome.side = plain_side(scene, *outcome.surface);
    }
    outcome.radiance = Vec3d(vertex.path.throughput) *
                       plain_emitted(scene, outcome.surface ? &*outcome.surface : nullptr, vertex.ray.origin, pdf_w, doubt);
    return !vertex.missed() && allows(rules, vertex.path.depth + 1);
}

// Path tracing with next-event estimation.
inline PlainOutcome plain_camera_vertex(const PlainScene& scene, const PlainVertex& vertex, const PathRules& rules,
                                        const PlainNumbers& numbers, Doubt& doubt)
{
    PlainOutcome outcome;
    if (!start_camera_vertex(scene, vertex, rules, vertex.path.pdf_w, outcome, doubt)) return outcome;
    const uint depth = vertex.path.depth;
    if (!outcome.side->specular() && !outcome.side->black()) {
        outcome.shadow = plain_direct_light(scene, *outcome.surface, *outcome.side, numbers.direct_light(depth), true, doubt);
        if (outcome.shadow) outcome.shadow->value = outcome.shadow->value * Vec3d(vertex.path.throughput);
    }
    outcome.next = plain_camera_step(vertex.path, *outcome.surface, *outcome.side, rules, numbers.scatter(depth, 1), doubt);
    return outcome;
}

// A path that ends at its first surface that is not specular, with a query there.
inline PlainOutcome plain_query_vertex(const PlainScene& scene, const PlainVertex& vertex, const PathRules& rules, bool direct_light,
                                       const PlainNumbers& numbers, Doubt& doubt)
{
    PlainOutcome outcome;
    if (!start_camera_vertex(scene, vertex, rules, 0.0, outcome, doubt)) return outcome;
    const uint depth = vertex.path.depth;
    if (outcome.side->specular()) {
        outcome.next = plain_camera_step(vertex.path, *outcome.surface, *outcome.side, rules, numbers.scatter(depth, 1), doubt);
        return outcome;
    }
    outcome.leaves_record = !outcome.side->black();
    if (outcome.leaves_record && direct_light) {
        outcome.shadow = plain_direct_light(scene, *outcome.surface, *outcome.side, numbers.direct_light(depth), false, doubt);
        if (outcome.shadow) outcome.shadow->value = outcome.shadow->value * Vec3d(vertex.path.throughput);
    }
    return outcome;
}

// Irradiance that arriving flux makes about the shading normal, over what it makes about the surface's own: what the end
// of a light path is multiplied by, [Veach 1997, section 5.3.2].
inline double plain_irradiance_scale(const PlainSurface& surface, Doubt& doubt)
{
    const double true_cosine = std::abs(dot(surface.outgoing, surface.geometric_normal));
    doubt.rests_on(true_cosine, 1e-2);
    return std::abs(dot(surface.outgoing, surface.shading_normal)) / true_cosine;
}

// A gather ray's path: a query at the first surface that is not specular, and no emission on the way. The light's path has at
// least one more edge.
inline PlainOutcome plain_gather_vertex(const PlainScene& scene, const PlainVertex& vertex, const PathRules& rules,
                                        const PlainNumbers& numbers, Doubt& doubt)
{
    PlainOutcome outcome;
    if (vertex.missed()) return outcome;
    outcome.surface = plain_surface(scene.flat, vertex.ray, vertex.hit, doubt);
    outcome.side = plain_side(scene, *outcome.surface);
    const uint depth = vertex.path.depth;
    outcome.leaves_record = !outcome.side->specular() && !outcome.side->black();
    if (outcome.side->specular() && allows(rules, depth + 2))
        outcome.next = plain_camera_step(vertex.path, *outcome.surface, *outcome.side, rules, numbers.scatter(depth, 1), doubt);
    return outcome;
}

// Photon mapping's light path; edges counted by direct light are left to it. A photon has at least one edge more to the
// camera, and the next one yet another. kept: as PHOTONS_KEPT.
inline PlainOutcome plain_photon_vertex(const PlainScene& scene, const PlainVertex& vertex, const PathRules& rules, bool direct_light,
                                        const PlainNumbers& numbers, Doubt& doubt, int kept = PHOTONS_ALL)
{
    PlainOutcome outcome;
    if (vertex.missed()) return outcome;
    outcome.surface = plain_surface(scene.flat, vertex.ray, vertex.hit, doubt);
    outcome.side = plain_side(scene, *outcome.surface);
    const uint depth = vertex.path.depth;
    const bool focused = (vertex.path.flags & PATH_SCATTERED_BROADLY) == 0;
    const bool asked_for = kept == PHOTONS_ALL || focused == (kept == PHOTONS_CAUSTIC);
    outcome.leaves_record = !outcome.side->specular() && !outcome.side->black() && !(direct_light && depth == 1) && asked_for;
    if (outcome.leaves_record) outcome.flux = Vec3d(vertex.path.throughput) * plain_irradiance_scale(*outcome.surface, doubt);
    if (allows(rules, depth + 2) && (kept != PHOTONS_CAUSTIC || outcome.side->specular()))
        outcome.next = plain_light_step(vertex.path, *outcome.surface, *outcome.side, rules, numbers.scatter(depth, 1), doubt);
    return outcome;
}

struct PlainSplat {
    PlainShadow shadow;
    std::array<int, 2> pixel; // of the crop
    double pdf_a;             // 1/m^2, with which a camera subpath of one pixel meets the surface there
    Vec3d direction;          // unit, to the lens
};

// [Veach 1997, section 8.3.2]: flux, f, the two cosines over the squared distance, and the importance of the lens.
inline std::optional<PlainSplat> plain_splat(const PlainScene& scene, const PlainSurface& surface, const PlainSide& side, Vec3d flux,
                                             const LensNumbers& u, Doubt& doubt)
{
    const Camera& camera = scene.camera;
    const auto view = plain_view(camera, surface.position, u.position, doubt);
    if (!view) return {};
    const auto x = plain_filter_choice(scene.filter, view->film[0], u.pixel[0], doubt);
    const auto y = plain_filter_choice(scene.filter, view->film[1], u.pixel[1], doubt);
    const std::array<int, 2> pixel{x.pixel - camera.crop_x, y.pixel - camera.crop_y};
    if (pixel[0] < 0 || pixel[1] < 0 || pixel[0] >= camera.crop_width || pixel[1] >= camera.crop_height) return {};

    const Vec3d way = view->lens - surface.position, direction = normalized(way);
    const Vec3d f = plain_evaluate(side, surface, direction, doubt);
    if (is_black(f)) return {};
    const double cosine = std::abs(dot(direction, surface.geometric_normal));
    doubt.rests_on(cosine, 1e-2);
    const double pdf_a = cosine / dot(way, way) * view->film_density;
    const double scale = plain_irradiance_scale(surface, doubt) * pdf_a * x.weight * y.weight;
    // The shadow ray ends at the plane of the near clip, whose distance from the lens is a share of the depth.
    const Vec3d origin = surface.ray_origin(direction);
    return PlainSplat{{{origin, view->lens - origin, 1.0 - double(camera.near_clip) / view->depth}, flux * f * scale}, pixel, pdf_a, direction};
}

// Light tracing: every vertex that is not specular is connected to the lens.
inline PlainOutcome plain_splat_vertex(const PlainScene& scene, const PlainVertex& vertex, const PathRules& rules,
                                       const PlainNumbers& numbers, std::optional<PlainSplat>& splat, Doubt& doubt)
{
    PlainOutcome outcome;
    const uint depth = vertex.path.depth;
    if (vertex.missed() || !allows(rules, depth + 1)) return outcome;
    outcome.surface = plain_surface(scene.flat, vertex.ray, vertex.hit, doubt);
    outcome.side = plain_side(scene, *outcome.surface);
    if (!outcome.side->specular() && !outcome.side->black())
        splat = plain_splat(scene, *outcome.surface, *outcome.side, vertex.path.throughput, numbers.lens(depth), doubt);
    if (splat) outcome.shadow = splat->shadow;
    outcome.next = plain_light_step(vertex.path, *outcome.surface, *outcome.side, rules, numbers.scatter(depth, 2), doubt);
    return outcome;
}

} // namespace sundog
