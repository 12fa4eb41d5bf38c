// Light sources: one record for each emissive primitive, point, spot, direction
// and environment, and the alias table that chooses among them.
#ifndef SUNDOG_SHARED_LIGHT_H
#define SUNDOG_SHARED_LIGHT_H
#include "shared/vec3.h"
SHARED_BEGIN

#define LIGHT_TRIANGLE 0u    // emission: radiance (W/m^2/sr) from the front side
#define LIGHT_SPHERE 1u      // the same
#define LIGHT_DISK 2u        // the same
#define LIGHT_POINT 3u       // emission: radiant intensity (W/sr)
#define LIGHT_SPOT 4u        // emission: radiant intensity on the axis (W/sr)
#define LIGHT_DIRECTIONAL 5u // emission: irradiance across the direction (W/m^2)
#define LIGHT_CONSTANT 6u    // emission: radiance from all directions (W/m^2/sr)
#define LIGHT_CYLINDER 7u    // as LIGHT_TRIANGLE
#define LIGHT_ENVMAP 8u      // emission: factor on the radiance of an EnvironmentMap

// Whether paths can only start there, never arrive.
#define LIGHT_IS_DELTA(type) ((type) == LIGHT_POINT || (type) == LIGHT_SPOT || (type) == LIGHT_DIRECTIONAL)

typedef struct Light {
    uint type;
    uint primitive;    // of an area light: as in Hit; of an environment map: its index
    float probability; // of being chosen by the alias table
    float area;        // of an area light (m^2); of an environment map its mean luminance
    Vec3 emission;
    float cutoff_angle; // spot: no light beyond this angle (rad)
    Vec3 position;      // point and spot
    float beam_width;   // spot: full intensity within this angle (rad)
    Vec3 direction;     // spot and directional: of propagation, unit length
    float unused;
} Light;
SHARED_SIZE(Light, 64);

// Vose's alias method: column i keeps i with probability `threshold`, else it
// yields `alias`.
typedef struct AliasEntry {
    float threshold;
    uint alias;
} AliasEntry;
SHARED_SIZE(AliasEntry, 8);

SHARED_END
#endif
