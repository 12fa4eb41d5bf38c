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
    float vc_specular; // vc, where the subpath's next scattering is specular (equal where that makes no difference)
} PathWeights;
SHARED_SIZE(PathWeights, 16);

// Beside a PathState. light: of a light subpath, where it started.
typedef struct Subpath {
    PathWeights weights;
    uint light;
} Subpath;
SHARED_SIZE(Subpath, 20);

// Which techniques join subpaths, as they enter the weights. merge: pi r^2 times the light subpaths of an iteration, 0
// without merging; inverse_merge: 1 over it. merge_unconnected: the same for a merge at a vertex that the one before it, towards
// the camera, could not be connected to, because that is specular or the camera's own: merge, or 0 where merging needs what
// connecting does. connect: 1, or 0 without connections (next-event estimation and the splats of light subpaths are two of them).
// light_paths: in an iteration.
typedef struct Techniques {
    float merge;
    float inverse_merge;
    float merge_unconnected;
    float connect;
    float light_paths;
} Techniques;
SHARED_SIZE(Techniques, 20);

// A vertex that can be joined to one of the other side.
typedef struct PathVertex {
    Vec3 position;
    float offset;    // as in Surface
    Vec3 throughput; // of a light subpath: flux (W), about the lobe's normal (irradiance_scale)
    uint depth;      // edges so far
    PathWeights weights;
    float merge;     // as in Techniques, at this vertex
    float eta_scale; // of a camera subpath, as in PathState
    uint unused[2];
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

// The light subpath's vertex where a photon lies: what it brings for the weight of a merge, and its slot (NO_VERTEX where only
// merging, which brings a lobe of its own, can join it).
typedef struct PhotonVertex {
    float vcm;
    float vm;
    uint slot;
} PhotonVertex;
SHARED_SIZE(PhotonVertex, 12);

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
