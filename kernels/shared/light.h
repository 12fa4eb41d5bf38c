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
#define LIGHT_PROJECTOR 9u   // emission: irradiance where the axis meets a plane one unit away (W/m^2)
#define LIGHT_COLLIMATED 10u // emission: flux along the one ray that it sends (W)

// Whether paths can only start there, never arrive.
#define LIGHT_IS_DELTA(type) \
    ((type) == LIGHT_POINT || (type) == LIGHT_SPOT || (type) == LIGHT_DIRECTIONAL || (type) == LIGHT_PROJECTOR || (type) == LIGHT_COLLIMATED)

// Whether it lies beyond the scene, in a direction rather than at a point.
#define LIGHT_IS_DISTANT(type) ((type) == LIGHT_DIRECTIONAL || (type) == LIGHT_CONSTANT || (type) == LIGHT_ENVMAP)

typedef struct Light {
    uint type;
    uint primitive;    // of an area light: as in Hit; of an environment map: its index;
                       // of a projector or a spot with a texture: the index of its LightProjection
    float probability; // of being chosen by the alias table
    float area;        // of an area light (m^2); of a projector its image, one unit away; of an
                       // environment map its mean luminance
    Vec3 emission;
    float cutoff_angle; // spot: no light beyond this angle (rad)
    Vec3 position;      // point, spot, projector and collimated
    float beam_width;   // spot: full intensity within this angle (rad)
    Vec3 direction;     // spot, projector, directional and collimated: of propagation, unit length
    uint texture;       // factor on the emission of an area light, spot or projector, or NO_TEXTURE
} Light;
SHARED_SIZE(Light, 64);

// Where a light's image lies on the plane one unit along its direction: x axis_x + y axis_y from the middle has the
// texture coordinates 1/2 - (x / half_width, y / half_height) / 2.
typedef struct LightProjection {
    Vec3 axis_x; // unit length, orthogonal to axis_y and the light's direction
    float half_width;
    Vec3 axis_y;
    float half_height;
} LightProjection;
SHARED_SIZE(LightProjection, 32);

// Vose's alias method: column i keeps i with probability `threshold`, else it
// yields `alias`.
typedef struct AliasEntry {
    float threshold;
    uint alias;
} AliasEntry;
SHARED_SIZE(AliasEntry, 8);

SHARED_END
#endif
