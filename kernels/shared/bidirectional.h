// Subpaths from the lights and from the camera that are joined: what each carries for its balance weights, and their vertices.
#ifndef SUNDOG_SHARED_BIDIRECTIONAL_H
#define SUNDOG_SHARED_BIDIRECTIONAL_H
#include "shared/bsdf.h"
#include "shared/path.h"
#include "shared/vec3.h"
SHARED_BEGIN

// Of a subpath at a vertex: sums of density ratios from which the balance heuristic follows without a look back along it
// [Georgiev 2012, Implementing Vertex Connection and Merging, eqs. 31 to 38].
typedef struct PathWeights {
    float vcm;
    float vc;
    float vm;
} PathWeights;
SHARED_SIZE(PathWeights, 12);

// Beside a PathState. light: of a light subpath, where it started.
typedef struct Subpath {
    PathWeights weights;
    uint light;
} Subpath;
SHARED_SIZE(Subpath, 16);

// Which techniques join subpaths, as they enter the weights. merge: pi r^2 times the light subpaths of an iteration, 0
// without merging; inverse_merge: 1 over it. connect: 1, or 0 without connections (next-event estimation and the splats of
// light subpaths are two of them). light_paths: in an iteration.
typedef struct Techniques {
    float merge;
    float inverse_merge;
    float connect;
    float light_paths;
} Techniques;
SHARED_SIZE(Techniques, 16);

// A vertex that can be joined to one of the other side.
typedef struct PathVertex {
    Vec3 position;
    float offset;    // as in Surface
    Vec3 throughput; // of a light subpath: flux (W), about the lobe's normal (irradiance_scale)
    uint depth;      // edges so far
    PathWeights weights;
    uint unused[5];
    LobeRecord lobe;
} PathVertex;
SHARED_SIZE(PathVertex, 192);

// Where a light subpath's vertices lie. They are apart from the vertices, which are large, so that following a path does not
// wait for memory at every step.
typedef struct VertexLink {
    uint previous; // slot of the path's vertex before this one, or NO_VERTEX
    uint rank;     // how many of the path's vertices there are up to this one; 0: the slot holds none
} VertexLink;
SHARED_SIZE(VertexLink, 8);

#define NO_VERTEX 0xffffffffu

// What a photon brings for the weight of a merge.
typedef struct MergeWeights {
    float vcm;
    float vm;
} MergeWeights;
SHARED_SIZE(MergeWeights, 8);

// A camera subpath and a light vertex to join it to.
typedef struct VertexPair {
    uint path;
    uint slot;
} VertexPair;
SHARED_SIZE(VertexPair, 8);

// More flags of a subpath at a vertex (shared/path.h): it left a vertex that can be joined.
#define PATH_JOINS 4u

SHARED_END
#endif
