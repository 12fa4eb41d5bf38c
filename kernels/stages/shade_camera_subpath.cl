// One vertex of a camera subpath. Reads hits of the active paths; adds emission to radiance; writes the vertex, which light
// subpaths are joined to, the light's shadow ray with what it would bring, the next ray, and whether the path left a vertex and
// goes on. One work-item an active path. -D REGULARIZED: specular vertices have light as well, on paths that no technique finds. Used
// by the bidirectional methods.
#include "scene/camera_rays.h"
#include "scene/continue_path.h"
#include "scene/direct_light.h"
#include "scene/mollified_light.h"
#include "scene/path_vertex.h"

static inline PathWeights arriving_weights(const Camera* camera, Techniques techniques, PathWeights weights, uint depth,
                                           const Surface* surface, float distance)
{
    const float cosine = fabs(dot(surface->outgoing, surface->geometric_normal));
    if (depth > 1u) return weights_at_vertex(weights, distance * distance, cosine);
    const float pdf_a = camera_ray_pdf_a(camera, -surface->outgoing, distance);
    const PathWeights first = {techniques.connect * techniques.light_paths / pdf_a, 0.0f, 0.0f, 0.0f};
    return weights_at_vertex(first, 1.0f, cosine);
}

// Radiance of a surface that the path found, weighted against the other ways to find it. What the camera sees itself, only
// it finds.
static inline float3 weighted_emission(const SurfaceView* scene, const Surface* surface, const PathState* path, PathWeights weights,
                                       Ray ray, float distance)
{
    const uint index = light_of_hit(scene, surface);
    const float3 emitted = emitted_radiance(scene, surface, index);
    if (is_black(emitted) || path->depth == 1u) return emitted;
    const Light light = scene->lights[index];
    const float cos_at_light = fabs(dot(surface->outgoing, surface->geometric_normal));
    const float pdf_connect = light_pdf_w(scene, surface, index, ray) * cos_at_light / (distance * distance);
    const float pdf_emit = light.probability / light.area * cos_at_light * INV_PI_F;
    return emitted * hit_weight(weights, pdf_connect, pdf_emit);
}

// The same where it left the scene.
static inline float3 weighted_environment(const SurfaceView* scene, const PathState* path, PathWeights weights, Ray ray)
{
    if (sees_no_light(ray)) return (float3)(0.0f);
    const EnvironmentValue value = environment_value(scene, normalize(unpack(ray.direction)));
    if (is_black(value.radiance) || path->depth == 1u) return value.radiance;
    // Light subpaths choose lights by power alone.
    const uint index = scene->globals->environment_light;
    const float choice = scene->lights[index].probability / light_probability(scene, index, (float3)(0.0f), 0u);
    return value.radiance * hit_weight(weights, value.pdf_w, value.pdf_w * choice * distant_ray_pdf_a(scene));
}

// Next-event estimation as in direct_light.h, weighted against the other ways to find the path [Georgiev 2012, eqs. 44 and 45].
static inline float3 connect_to_light(const SurfaceView* scene, const Surface* surface, const Scattering* scattering, PathWeights weights,
                                      Techniques techniques, uint4 words, Ray* shadow_ray)
{
    *shadow_ray = no_ray();
    LightSample light;
    if (!sample_light(scene, surface, 0u, words, &light)) return (float3)(0.0f);
    const float3 f = bsdf_evaluate(scattering, surface, light.direction, CARRIES_RADIANCE);
    if (is_black(f)) return (float3)(0.0f);
    *shadow_ray = light.shadow_ray;
    const BsdfDensities densities = bsdf_densities(scattering, surface, light.direction);
    const float light_share = light.pdf_w == PDF_DELTA ? 0.0f : densities.pdf_w / light.pdf_w;
    const float emitted_pdf_a = light.emission_ratio * fabs(dot(light.direction, surface->geometric_normal));
    const float camera_share = connection_share(weights, techniques.merge, emitted_pdf_a, densities.reverse_pdf_w);
    return f * light.radiance * (joint_weight(light_share, camera_share) * fabs(dot(light.direction, scattering->normal)));
}

__kernel void shade_camera_subpath(SURFACE_PARAMETERS, Camera camera, SAMPLER_PARAMETERS, PathRules rules, Techniques techniques,
                                   Regularization regularization, __global const Hit* restrict hits, __global const uint* restrict active,
                                   __global const uint* restrict active_count, __global Ray* restrict rays,
                                   __global PathState* restrict paths, __global Subpath* restrict subpaths,
                                   __global Vec3* restrict radiance, __global Ray* restrict shadow_rays,
                                   __global Vec3* restrict shadow_radiance, __global PathVertex* restrict vertices,
                                   __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    const SurfaceView scene = SURFACE_VIEW;
    PathState path = paths[index];
    const float3 throughput = unpack(path.throughput);
    // Not into the argument, which the work-items of a group may share.
    const Techniques here = techniques_at(techniques, path.depth > 1u && path.pdf_w != PDF_DELTA);
    const Hit hit = hits[index];
    const Ray ray = rays[index];
    PathWeights weights = subpaths[index].weights;
    flags[item] = PATH_ENDED;
    shadow_rays[index].t_max = 0.0f;
    if (path.depth > rules.max_depth) return;
    if (hit.primitive == NO_PRIMITIVE) {
        radiance[index] = pack(unpack(radiance[index]) + throughput * weighted_environment(&scene, &path, weights, ray));
        return;
    }
    const Surface surface = surface_at(&scene, ray, hit);
    weights = arriving_weights(&camera, here, weights, path.depth, &surface, hit.t);
    const float3 emitted = weighted_emission(&scene, &surface, &path, weights, ray, hit.t);
    if (!is_black(emitted)) radiance[index] = pack(unpack(radiance[index]) + throughput * emitted);
    if (path.depth >= rules.max_depth) return;

    Sampler sampler = camera_sampler(SAMPLER_VIEW, index, path.depth);
    const uint4 words = next_words(&sampler);
    Scattering scattering = scattering_at(&scene, &surface, unit_float(words.w));
    disperse(camera_hero(&scene, key, index), &path, &scattering);
    uint flag = PATH_ENDED;
    if (can_be_joined(&scattering)) {
        pack_vertex(&surface, &scattering, throughput, path.depth, weights, here.merge, path.eta_scale, vertices + index);
        flag |= PATH_JOINS;
        if (path.depth == 1u || path.pdf_w != PDF_DELTA) path.flags |= PATH_CONNECTABLE;
        if (here.connect > 0.0f) {
            Ray shadow_ray;
            shadow_radiance[index] =
                pack(throughput * connect_to_light(&scene, &surface, &scattering, weights, here, words, &shadow_ray));
            shadow_rays[index] = shadow_ray;
        }
    } else if (REGULARIZED && !(path.flags & PATH_CONNECTABLE) && path.scattered > 0u && is_specular(&scattering)) {
        const float4 u = unit_float4(camera_words(SAMPLER_VIEW, index, path.depth, BLOCK_SPARE));
        Ray shadow_ray;
        shadow_radiance[index] = pack(sample_mollified_light(&scene, &surface, &scattering, throughput, regularization, words, u, &shadow_ray));
        shadow_rays[index] = shadow_ray;
    }
    Ray next;
    if (continue_camera_path(&surface, &scattering, rules, &sampler, &path, &next)) {
        if (!sees_no_light(next)) next.horizon = 0u; // the chance of a light must be the same in all weights
        subpaths[index].weights = weights_along(weights, here, &surface, &scattering, path.pdf_w, unpack(next.direction));
        rays[index] = next;
        paths[index] = path;
        flag |= PATH_ALIVE;
    }
    flags[item] = flag;
}
