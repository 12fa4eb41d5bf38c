// What a texture says at a surface.
#ifndef SUNDOG_SCENE_TEXTURE_H
#define SUNDOG_SCENE_TEXTURE_H
#include "math/luminance.h"
#include "scene/surface.h"

// Value in [0, 1] of a display encoding, made linear (IEC 61966-2-1).
static inline float srgb_decode(float encoded)
{
    return encoded <= 0.04045f ? encoded * (1.0f / 12.92f) : native_powr((encoded + 0.055f) * (1.0f / 1.055f), 2.4f);
}

// In place of a texel's number where there is none.
#define TEXEL_ZERO 0xffffffffu
#define TEXEL_ONE 0xfffffffeu

static inline float3 read_texel(const SurfaceView* scene, const Texture* texture, uint x, uint y)
{
    const uint farther = max(x, y);
    if (farther >= TEXEL_ONE) return (float3)((x >= TEXEL_ONE ? x : y) == TEXEL_ONE ? 1.0f : 0.0f);
    const size_t index = (size_t)y * texture->width + x;
    if (texture->format == TEXELS_HALF) return vload_half4(0, (__global const half*)(scene->texels + texture->first_texel + 2u * index)).xyz;
    if (texture->format == TEXELS_FLOAT) return vload3(0, (__global const float*)(scene->texels + texture->first_texel + 3u * index));
    const uint texel = scene->texels[texture->first_texel + index];
    const float3 value = convert_float3((uint3)(texel & 0xffu, (texel >> 8) & 0xffu, (texel >> 16) & 0xffu)) * (1.0f / 255.0f);
    if (texture->format == TEXELS_LINEAR) return value;
    return (float3)(srgb_decode(value.x), srgb_decode(value.y), srgb_decode(value.z));
}

// Texel number along one axis for any integer.
static inline uint wrap_texel(int i, int size, uint wrap)
{
    if (wrap == WRAP_CLAMP) return (uint)clamp(i, 0, size - 1);
    if (wrap >= WRAP_ZERO && (i < 0 || i >= size)) return wrap == WRAP_ONE ? TEXEL_ONE : TEXEL_ZERO;
    const int period = wrap == WRAP_MIRROR ? 2 * size : size;
    int inside = i % period;
    if (inside < 0) inside += period;
    return (uint)(inside < size ? inside : period - 1 - inside);
}

// How the luminance of a bitmap changes with its u and v, between the texels around.
static inline float2 bitmap_slope(const SurfaceView* scene, const Texture* texture, float2 uv)
{
    const int width = (int)texture->width, height = (int)texture->height;
    const float2 size = (float2)((float)width, (float)height), limit = 1e9f / size;
    const float2 point = clamp(uv, -limit, limit) * size;
    const float2 corner = floor(point - 0.5f);
    const float2 t = point - 0.5f - corner;
    const int x = (int)corner.x, y = (int)corner.y;
    const uint x0 = wrap_texel(x, width, texture->wrap_u), x1 = wrap_texel(x + 1, width, texture->wrap_u);
    const uint y0 = wrap_texel(y, height, texture->wrap_v), y1 = wrap_texel(y + 1, height, texture->wrap_v);
    const float a = dot(read_texel(scene, texture, x0, y0), LUMINANCE_WEIGHTS), b = dot(read_texel(scene, texture, x1, y0), LUMINANCE_WEIGHTS);
    const float c = dot(read_texel(scene, texture, x0, y1), LUMINANCE_WEIGHTS), d = dot(read_texel(scene, texture, x1, y1), LUMINANCE_WEIGHTS);
    return size * (float2)(mix(b - a, d - c, t.y), mix(c - a, d - b, t.x));
}

// Bilinear between texel centres, or the texel at the point. v runs down the image's rows.
static inline float3 read_bitmap(const SurfaceView* scene, const Texture* texture, float2 uv)
{
    const int width = (int)texture->width, height = (int)texture->height;
    // Far outside of [0, 1] a float has no texels left, nor has an int room for them.
    const float2 limit = (float2)(1e9f / (float)width, 1e9f / (float)height);
    const float2 point = clamp(uv, -limit, limit) * (float2)((float)width, (float)height);
    if (texture->filter == FILTER_NEAREST)
        return read_texel(scene, texture, wrap_texel((int)floor(point.x), width, texture->wrap_u), wrap_texel((int)floor(point.y), height, texture->wrap_v));
    const float2 corner = floor(point - 0.5f);
    const float2 t = point - 0.5f - corner;
    const int x = (int)corner.x, y = (int)corner.y;
    const uint x0 = wrap_texel(x, width, texture->wrap_u), x1 = wrap_texel(x + 1, width, texture->wrap_u);
    const uint y0 = wrap_texel(y, height, texture->wrap_v), y1 = wrap_texel(y + 1, height, texture->wrap_v);
    const float3 above = mix(read_texel(scene, texture, x0, y0), read_texel(scene, texture, x1, y0), t.x);
    const float3 below = mix(read_texel(scene, texture, x0, y1), read_texel(scene, texture, x1, y1), t.x);
    return mix(above, below, t.y);
}

#if HAS_UV
static inline float3 read_attribute(const SurfaceView* scene, const Texture* texture, const Surface* surface)
{
    if (surface->primitive & ANALYTIC_BIT) return (float3)(0.0f);
    const AttributeRange range = scene->attribute_ranges[surface->shape * scene->globals->attribute_count + texture->attribute];
    if (range.kind == NO_ATTRIBUTE) return (float3)(0.0f);
    if (range.kind == ATTRIBUTE_PER_FACE) return unpack(scene->attribute_values[range.base + surface->primitive]);
    const Triangle triangle = scene->triangles[surface->primitive];
    const float2 b = surface->barycentric;
    return unpack(scene->attribute_values[range.base + triangle.vertex[0]]) * (1.0f - b.x - b.y) +
           unpack(scene->attribute_values[range.base + triangle.vertex[1]]) * b.x + unpack(scene->attribute_values[range.base + triangle.vertex[2]]) * b.y;
}

static inline float3 clamp_to_range(float3 value, uint range)
{
    if (range == RANGE_UNIT) return clamp(value, 0.0f, 1.0f);
    if (range == RANGE_POSITIVE) return fmax(value, 0.0f);
    return value;
}

// A checkerboard's fields may be textures themselves: the loop follows them, with the value so far.
static inline float3 textured_color(const SurfaceView* scene, TexturedColor color, const Surface* surface)
{
    float3 value = unpack(color.value);
    while (color.texture != NO_TEXTURE) {
        const Texture texture = scene->textures[color.texture];
        const float3 place = (float3)(surface->uv, 1.0f);
        const float2 uv = (float2)(dot((float3)(texture.to_u[0], texture.to_u[1], texture.to_u[2]), place),
                                   dot((float3)(texture.to_v[0], texture.to_v[1], texture.to_v[2]), place));
        if (texture.type == TEXTURE_BITMAP) return clamp_to_range(value * read_bitmap(scene, &texture, uv), texture.range);
        if (texture.type == TEXTURE_ATTRIBUTE) return clamp_to_range(value * read_attribute(scene, &texture, surface), texture.range);
        const bool left = uv.x - floor(uv.x) > 0.5f, low = uv.y - floor(uv.y) > 0.5f;
        color = texture.colors[left == low ? 0 : 1];
        value *= unpack(color.value);
    }
    return value;
}
#else
static inline float3 textured_color(const SurfaceView* scene, TexturedColor color, const Surface* surface) { return unpack(color.value); }
#endif

#if HAS_UV
// How a number changes with the surface's u and v: a bitmap's slope, and none on the squares of a checkerboard.
static inline float2 textured_slope(const SurfaceView* scene, TexturedNumber number, const Surface* surface)
{
    if (number.texture == NO_TEXTURE) return (float2)(0.0f);
    const Texture texture = scene->textures[number.texture];
    if (texture.type != TEXTURE_BITMAP) return (float2)(0.0f);
    const float3 place = (float3)(surface->uv, 1.0f);
    const float3 to_u = (float3)(texture.to_u[0], texture.to_u[1], texture.to_u[2]), to_v = (float3)(texture.to_v[0], texture.to_v[1], texture.to_v[2]);
    const float2 slope = number.value * bitmap_slope(scene, &texture, (float2)(dot(to_u, place), dot(to_v, place)));
    return (float2)(slope.x * to_u.x + slope.y * to_v.x, slope.x * to_u.y + slope.y * to_v.y);
}
#endif

static inline float textured_number(const SurfaceView* scene, TexturedNumber number, const Surface* surface)
{
    if (number.texture == NO_TEXTURE) return number.value;
    const TexturedColor color = {{1.0f, 1.0f, 1.0f}, number.texture};
    return number.value * dot(textured_color(scene, color, surface), LUMINANCE_WEIGHTS);
}

#endif
