// Textures: values that vary over a surface.
#ifndef SUNDOG_SHARED_TEXTURE_H
#define SUNDOG_SHARED_TEXTURE_H
#include "shared/vec2.h"
#include "shared/vec3.h"
SHARED_BEGIN

#define NO_TEXTURE 0xffffffffu

// value, times what the texture (an index into `textures`) says there.
typedef struct TexturedColor {
    Vec3 value;
    uint texture;
} TexturedColor;
SHARED_SIZE(TexturedColor, 16);

// The same for a number: value times the texture's luminance.
typedef struct TexturedNumber {
    float value;
    uint texture;
} TexturedNumber;
SHARED_SIZE(TexturedNumber, 8);

#define TEXTURE_BITMAP 0u
#define TEXTURE_CHECKERBOARD 1u // colors[0] and [1] in turn, on squares of half a unit
#define TEXTURE_ATTRIBUTE 2u    // a value that the mesh gives

#define TEXELS_SRGB 0u   // a uint: red, green and blue in its low bytes, encoded by IEC 61966-2-1
#define TEXELS_LINEAR 1u // the same, linear
#define TEXELS_HALF 2u   // two uints: four half floats (red, green, blue, nothing), linear
#define TEXELS_FLOAT 3u  // three uints: floats, linear

#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u
#define WRAP_ZERO 3u // outside of the image all is 0
#define WRAP_ONE 4u  // or 1

#define FILTER_NEAREST 0u
#define FILTER_BILINEAR 1u

// What a texture's value, times its factor, is clamped to.
#define RANGE_ANY 0u
#define RANGE_POSITIVE 1u // 0 and more
#define RANGE_UNIT 2u     // 0 to 1

typedef struct Texture {
    uint type;
    uint width; // bitmap: texels
    uint height;
    uint first_texel; // its place in `texels`, in uints
    uint format;
    uint wrap_u;
    uint filter;
    uint attribute; // TEXTURE_ATTRIBUTE: its number among the scene's attributes
    float to_u[3];  // u' = to_u . (u, v, 1)
    float to_v[3];
    uint wrap_v;
    uint range;
    TexturedColor colors[2];
} Texture;
SHARED_SIZE(Texture, 96);

// Where a shape's values of an attribute lie in `attribute_values`. base: add a vertex (or, per face, a
// primitive) number, modulo 2^32. NO_ATTRIBUTE: the shape has none, and the value is 0.
typedef struct AttributeRange {
    uint base;
    uint kind;
} AttributeRange;
SHARED_SIZE(AttributeRange, 8);

#define NO_ATTRIBUTE 0u
#define ATTRIBUTE_PER_VERTEX 1u
#define ATTRIBUTE_PER_FACE 2u

SHARED_END
#endif
