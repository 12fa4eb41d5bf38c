// One vertex of a light subpath. Reads hits of the active paths; writes the vertex, which camera subpaths connect to, at
// first_slot + item, linked to the path's one before it; the splat that it would bring to the film and its shadow ray; the
// photon that it leaves for merging (item by item) with what that brings for its weight; the next ray; and whether the path
// goes on. One work-item an active path. Used by the bidirectional methods.
#include "density/leave_photon.h"
#include "scene/lens_connection.h"
#include "scene/lights.h"
#include "scene/path_vertex.h"

static inline PathWeights arriving_weights(const SurfaceView* scene, const Subpath* subpath, uint depth, const Surface* surface, Ray ray,
                                           float distance)
{
    const float cosine = fabs(dot(surface->outgoing, surface->geometric_normal));
    if (depth > 1u) return weights_at_vertex(subpath->weights, distance * distance, cosine);
    const bool distant = LIGHT_IS_DISTANT(scene->lights[subpath->light].type);
    PathWeights weights = weights_at_vertex(subpath->weights, distant ? 1.0f : distance * distance, cosine);
    weights.vcm *= connect_ratio(scene, subpath->light, unpack(ray.origin), surface->position, unpack(ray.direction));
    return weights;
}

// The light's side of the weight against all that the camera's could have found [Georgiev 2012, eq. 46].
static inline float splat_weight(const LensConnection* connection, const Surface* surface, const Scattering* scattering,
                                 PathWeights weights, Techniques techniques)
{
    const float reverse_pdf_w = bsdf_densities(scattering, surface, connection->direction).reverse_pdf_w;
    return joint_weight(connection_share(weights, techniques.merge_unconnected, connection->pdf_a / techniques.light_paths, reverse_pdf_w), 0.0f);
}

__kernel void shade_light_subpath(SURFACE_PARAMETERS, Camera camera, __global const PixelFilter* restrict filter, SAMPLER_PARAMETERS,
                                  PathRules rules, Techniques techniques, uint path_count, uint first_slot,
                                  __global const Hit* restrict hits, __global const uint* restrict active,
                                  __global const uint* restrict active_count, __global Ray* restrict rays,
                                  __global PathState* restrict paths, __global Subpath* restrict subpaths,
                                  __global PathVertex* restrict vertices, __global VertexLink* restrict links,
                                  __global uint* restrict last_vertices, __global Ray* restrict shadow_rays,
                                  __global Splat* restrict splats, __global Photon* restrict photons,
                                  __global PhotonVertex* restrict photon_vertices, __global uint* restrict flags)
{
    const uint item = get_global_id(0);
    if (item >= *active_count) return;
    const uint index = active[item];
    const uint slot = first_slot + item;
    const bool connects = techniques.connect > 0.0f;
    flags[item] = PATH_ENDED;
    shadow_rays[index].t_max = 0.0f;
    if (connects) links[slot].rank = 0u;
    const Hit hit = hits[index];
    if (hit.primitive == NO_PRIMITIVE) return;

    const SurfaceView scene = SURFACE_VIEW;
    PathState path = paths[index];
    // The camera's side of the path has at least one edge.
    if (path.depth >= rules.max_depth) return;
    const Ray ray = rays[index];
    Subpath subpath = subpaths[index];
    const Surface surface = surface_at(&scene, ray, hit);
    subpath.weights = arriving_weights(&scene, &subpath, path.depth, &surface, ray, hit.t);
    Sampler sampler = light_sampler(SAMPLER_VIEW, index, path_count, path.depth);
    const float4 u = next_4d(&sampler);
    Scattering scattering = scattering_at(&scene, &surface, next_4d(&sampler).x);
    disperse(light_hero(&scene, key, index), &path, &scattering);
    uint flag = PATH_ENDED;
    if (techniques.merge > 0.0f && wants_photons(&scene, &surface, false)) {
        const PhotonVertex vertex = {subpath.weights.vcm, subpath.weights.vm, connects && can_be_joined(&scattering) ? slot : NO_VERTEX};
        photons[item] = make_photon(&surface, &path, false);
        photon_vertices[item] = vertex;
        flag |= PATH_DEPOSIT;
    }
    if (connects && can_be_joined(&scattering)) {
        const float3 flux = unpack(path.throughput);
        pack_vertex(&surface, &scattering, flux * irradiance_scale(&surface, scattering.normal), path.depth, subpath.weights, techniques.merge,
                    1.0f, vertices + slot);
        const uint previous = last_vertices[index];
        const VertexLink link = {previous, previous == NO_VERTEX ? 1u : links[previous].rank + 1u};
        links[slot] = link;
        last_vertices[index] = slot;

        LensConnection connection = connect_to_lens(&scene, &camera, filter, &surface, &scattering, flux, u);
        if (connection.shadow_ray.t_max > 0.0f) {
            const float weight = splat_weight(&connection, &surface, &scattering, subpath.weights, techniques);
            connection.splat.radiance = pack(unpack(connection.splat.radiance) * weight);
        }
        splats[item] = connection.splat;
        shadow_rays[index] = connection.shadow_ray;
    }
    Ray next;
    if (path.depth + 1u < rules.max_depth && continue_light_path(&surface, &scattering, rules, &sampler, &path, &next)) {
        subpath.weights = weights_along(subpath.weights, techniques, &surface, &scattering, path.pdf_w, unpack(next.direction));
        rays[index] = next;
        paths[index] = path;
        subpaths[index] = subpath;
        flag |= PATH_ALIVE;
    }
    flags[item] = flag;
}
