// Directions that may lead a camera subpath into a ball: uniform in the cone that bounds it. Against the density that the subpath's own
// sampling has there, a direction counts with probability density over bound, so that the chance P of meeting the ball is that of
// a trial times bound and solid angle: few trials, where those of the lobe itself would take as many as there are light vertices.
#ifndef SUNDOG_SCENE_TRIAL_CONE_H
#define SUNDOG_SCENE_TRIAL_CONE_H
#include "math/frame.h"
#include "math/warp.h"
#include "scene/continue_path.h"
#include "scene/path_vertex.h"

typedef struct TrialCone {
    Frame frame;         // n: the axis
    float one_minus_cos; // 2: there is no cone, the vertex is in the ball
    float solid_angle;   // sr
} TrialCone;

// Rays start a little beside the vertex.
static inline TrialCone bounding_cone(const Surface* surface, float3 center, float radius)
{
    const float3 between = center - surface->position;
    const float distance_squared = dot(between, between);
    const float reach = radius + 2.0f * surface->offset;
    const float sin_squared = reach * reach / distance_squared;
    TrialCone cone;
    cone.frame = make_frame(between * rsqrt(fmax(distance_squared, 1e-30f)));
    cone.one_minus_cos = sin_squared < 1.0f ? sin_squared / (1.0f + sqrt(1.0f - sin_squared)) : 2.0f;
    cone.solid_angle = 2.0f * PI_F * cone.one_minus_cos;
    return cone;
}

// The largest cosine to `normal` in the cone, over pi.
static inline float largest_cosine_pdf(const TrialCone* cone, float3 normal)
{
    const float cos_axis = dot(cone->frame.n, normal), cos_cone = 1.0f - cone->one_minus_cos;
    if (cos_axis >= cos_cone) return INV_PI_F;
    const float sin_axis = sqrt(fmax(0.0f, 1.0f - cos_axis * cos_axis)), sin_cone = sqrt(fmax(0.0f, 1.0f - cos_cone * cos_cone));
    return fmax(cos_axis * cos_cone + sin_axis * sin_cone, 0.0f) * INV_PI_F;
}

// Lobes whose directions have the density of the cosine.
static inline bool samples_cosine(const Scattering* scattering)
{
    return scattering->lobe == LOBE_DIFFUSE || scattering->lobe == LOBE_COATED_DIFFUSE || scattering->lobe == LOBE_PRINCIPLED_DIFFUSE;
}

// About the largest density of a lobe in the cone, or 0 where the lobe's own directions do as well as the cone's. found_pdf_w: at
// the direction that the path itself took into the ball. A density beyond it is no error (judge_trials.cl), but noise.
static inline float density_bound(const Surface* surface, const Scattering* scattering, const TrialCone* cone, float found_pdf_w)
{
    if (cone->one_minus_cos >= 1.0f) return 0.0f;
    float bound = found_pdf_w;
    if (samples_cosine(scattering)) {
        bound = largest_cosine_pdf(cone, scattering->normal);
    } else {
        for (uint i = 0u; i < 9u; ++i) { // the axis, and two rings of four
            const float2 u = (float2)(i == 0u ? 0.0f : i < 5u ? 0.3f : 1.0f, (float)i * 0.25f + (i < 5u ? 0.0f : 0.125f));
            const float3 direction = to_world(cone->frame, sample_cone((float2)(u.x, u.y - floor(u.y)), cone->one_minus_cos));
            bound = fmax(bound, bsdf_pdf_w(scattering, surface, direction));
        }
        bound *= 1.25f;
    }
    return bound * cone->solid_angle < 1.0f ? bound : 0.0f;
}

// Squared relative index that a path crosses, as BsdfSample has it.
static inline float crossed_eta_scale(const Scattering* scattering, float3 direction)
{
    if (scattering->lobe != LOBE_ROUGH_DIELECTRIC || dot(direction, scattering->normal) * scattering->cos_o > 0.0f) return 1.0f;
    return scattering->cos_o > 0.0f ? scattering->eta * scattering->eta : 1.0f / (scattering->eta * scattering->eta);
}

// Density (1/sr) with which a path at the vertex takes a direction and goes on, as extend_camera_path does.
static inline float continuation_pdf_w(const Surface* surface, const Scattering* scattering, PathRules rules, const PathState* path,
                                       float3 direction)
{
    const float3 f = bsdf_evaluate(scattering, surface, direction, CARRIES_RADIANCE);
    const float pdf_w = bsdf_pdf_w(scattering, surface, direction);
    if (is_black(f) || !(pdf_w > 0.0f)) return 0.0f;
    if (path->depth < rules.rr_depth) return pdf_w;
    const float3 throughput = unpack(path->throughput) * f * (fabs(dot(direction, scattering->normal)) / pdf_w);
    return pdf_w * camera_survival(throughput, path->eta_scale * crossed_eta_scale(scattering, direction));
}

// The state of a camera path as it arrived at a vertex.
static inline PathState path_at(__global const PathVertex* vertex)
{
    PathState path;
    path.throughput = vertex->throughput;
    path.pdf_w = PDF_DELTA;
    path.depth = vertex->depth;
    path.scattered = 0u;
    path.eta_scale = vertex->eta_scale;
    path.flags = 0u;
    return path;
}

#endif
