// Vertices of subpaths in memory, to be joined to others later.
#ifndef SUNDOG_SCENE_PATH_VERTEX_H
#define SUNDOG_SCENE_PATH_VERTEX_H
#include "scene/bsdf.h"
#include "scene/path_weights.h"

// How much of a vertex there is to read.
#define VERTEX_LINES (LOBES_ARE_LONG ? 3u : 2u)

static inline void pack_vertex(const Surface* surface, const Scattering* scattering, float3 throughput, uint depth, PathWeights weights,
                               float merge, float eta_scale, __global PathVertex* vertex)
{
    vertex->position = pack(surface->position);
    vertex->offset = surface->offset;
    vertex->throughput = pack(throughput);
    vertex->depth = depth;
    vertex->weights = weights;
    vertex->merge = merge;
    vertex->eta_scale = eta_scale;
    pack_lobe(scattering, surface, &vertex->lobe);
}

// The lobe at a vertex, with as much of its surface as evaluating it and leaving it takes.
static inline Scattering scattering_of(__global const PathVertex* vertex, Surface* surface)
{
    surface->position = unpack(vertex->position);
    surface->offset = vertex->offset;
    return unpack_lobe(&vertex->lobe, surface);
}

// What a subpath carries on when it leaves a vertex along `next`.
static inline PathWeights weights_along(PathWeights weights, Techniques techniques, const Surface* surface, const Scattering* scattering,
                                        float pdf_w, float3 next)
{
    const float reverse_pdf_w = pdf_w == PDF_DELTA ? 0.0f : bsdf_densities(scattering, surface, next).reverse_pdf_w;
    return weights_after_scattering(weights, techniques, pdf_w, reverse_pdf_w, fabs(dot(next, surface->geometric_normal)));
}

// The subpath may leave a vertex that can be joined to others.
static inline bool can_be_joined(const Scattering* scattering)
{
    return !is_specular(scattering) && !is_black_side(scattering);
}

#endif
