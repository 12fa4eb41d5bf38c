// Parameters of Disney's principled BSDF, each in [0, 1]; the index of refraction is in its Bsdf.
#ifndef SUNDOG_SHARED_PRINCIPLED_H
#define SUNDOG_SHARED_PRINCIPLED_H
#include "shared/texture.h"
SHARED_BEGIN

typedef struct Principled {
    TexturedColor base_color;
    TexturedNumber roughness;   // square root of the microfacets' alpha
    TexturedNumber anisotropic; // alpha_u over alpha_v is 1 / (1 - 0.9 anisotropic)
    TexturedNumber metallic;
    TexturedNumber spec_trans; // share of what is not metal that is glass
    TexturedNumber spec_tint;  // of the dielectric reflection, towards base_color
    TexturedNumber sheen;
    TexturedNumber sheen_tint;
    TexturedNumber flatness; // of the diffuse part, from Burley's diffuse model to his subsurface approximation
    TexturedNumber clearcoat;
    TexturedNumber clearcoat_gloss;
} Principled;
SHARED_SIZE(Principled, 96);

SHARED_END
#endif
