// Weights by the balance heuristic for all ways to make a path: the camera subpath hits the light, next-event estimation, connection of
// two vertices, merging of two vertices, the light subpath is seen by the camera. Each subpath carries three numbers, one of them in two versions (PathWeights), from
// which its side's share of the weight follows at any vertex [Georgiev 2012, Implementing Vertex Connection and Merging].
// Densities p are those of the samplers without Russian roulette: any weights that sum to 1 over the techniques are unbiased.
#ifndef SUNDOG_SCENE_PATH_WEIGHTS_H
#define SUNDOG_SCENE_PATH_WEIGHTS_H
#include "shared/bidirectional.h"

// Keeps products of extreme densities finite; a path of such a weight counts for nothing in either case.
#define LARGEST_WEIGHT 1e30f

static inline PathWeights bounded(PathWeights weights)
{
    weights.vcm = fmin(weights.vcm, LARGEST_WEIGHT);
    weights.vc = fmin(weights.vc, LARGEST_WEIGHT);
    weights.vm = fmin(weights.vm, LARGEST_WEIGHT);
    weights.vc_specular = fmin(weights.vc_specular, LARGEST_WEIGHT);
    return weights;
}

// From what weights_after_scattering left, or a subpath's start, to the next vertex, which the ray met at `cosine` to its
// geometric normal (absolute), after a distance whose square is given.
static inline PathWeights weights_at_vertex(PathWeights weights, float distance_squared, float cosine)
{
    const float inverse = 1.0f / fmax(cosine, 1e-7f);
    weights.vcm *= distance_squared * inverse;
    weights.vc *= inverse;
    weights.vm *= inverse;
    weights.vc_specular *= inverse;
    return bounded(weights);
}

// pdf_w: of the direction that the subpath takes; reverse_pdf_w: of sampling from it the direction that the subpath came from;
// cosine: of the new direction to the geometric normal (absolute).
static inline PathWeights weights_after_scattering(PathWeights weights, Techniques techniques, float pdf_w, float reverse_pdf_w,
                                                   float cosine)
{
    PathWeights next;
    if (pdf_w == PDF_DELTA) {
        next.vcm = 0.0f;
        next.vc = cosine * weights.vc_specular;
        next.vm = cosine * weights.vm;
        next.vc_specular = next.vc;
        return next;
    }
    const float inverse = 1.0f / pdf_w;
    next.vcm = techniques.connect * inverse;
    next.vc = cosine * inverse * (techniques.merge + weights.vcm + reverse_pdf_w * weights.vc);
    next.vm = cosine * inverse * (1.0f + weights.vcm * techniques.inverse_merge + reverse_pdf_w * weights.vm);
    next.vc_specular = cosine * inverse * (techniques.merge_unconnected + weights.vcm + reverse_pdf_w * weights.vc);
    return bounded(next);
}

// A camera subpath knows at each vertex whether the one before it can be connected.
static inline Techniques techniques_at(Techniques techniques, bool connected)
{
    if (!connected) techniques.merge = techniques.merge_unconnected;
    techniques.merge_unconnected = techniques.merge;
    return techniques;
}

// One side's share where the vertex is joined to one that generates it with density pdf_a (1/m^2). merge: as in Techniques, at this
// vertex; reverse_pdf_w: of sampling, from the direction of the other vertex, the one that this side's subpath came from.
static inline float connection_share(PathWeights weights, float merge, float pdf_a, float reverse_pdf_w)
{
    return pdf_a * (merge + weights.vcm + reverse_pdf_w * weights.vc);
}

// One side's share where the vertex is merged with one of the other side.
static inline float merge_share(float vcm, float vm, Techniques techniques, float reverse_pdf_w)
{
    return vcm * techniques.inverse_merge + reverse_pdf_w * vm;
}

// Of a camera subpath that arrived on a light. pdf_connect: with which next-event estimation at the vertex before would have
// chosen the point (or the direction, of a distant light); pdf_emit: of the light subpath's first ray, product of the densities of
// its point and its direction.
static inline float hit_weight(PathWeights weights, float pdf_connect, float pdf_emit)
{
    return 1.0f / (1.0f + pdf_connect * weights.vcm + pdf_emit * weights.vc);
}

static inline float joint_weight(float light_share, float camera_share)
{
    return 1.0f / (1.0f + light_share + camera_share);
}

#endif
