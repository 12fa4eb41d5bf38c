// Choosing a light, and the chance of each. By power alone, with an alias table; or, with -D LIGHT_TREE=1, next-event
// estimation chooses by a tree, for a point and the horizon (kernels/scene/horizon.h) of the surface there.
// Random numbers are whole words: at 10^5 lights the 24 bits of a float would favour some by a percent.
#ifndef SUNDOG_SCENE_LIGHT_CHOICE_H
#define SUNDOG_SCENE_LIGHT_CHOICE_H
#include "math/hash.h"
#include "scene/horizon.h"
#include "scene/scene_view.h"

#ifndef LIGHT_TREE
#define LIGHT_TREE 0
#endif

typedef struct LightChoice {
    uint light; // or NO_LIGHT, where none can be seen
    float probability;
    float rest; // what the choice has left of its random number, in [0, 1)
} LightChoice;

// [Vose 1991] with a uniform word: its product with the number of columns holds the column in its upper word, and the
// place within the column in the lower one.
static inline LightChoice choose_light_by_power(const SurfaceView* scene, uint word)
{
    const uint count = scene->globals->light_count;
    const uint column = mul_hi(word, count);
    const AliasEntry entry = scene->light_alias[column];
    const float place = (float)(word * count) * 0x1p-32f;
    const bool kept = place < entry.threshold;
    LightChoice choice;
    choice.light = kept ? column : entry.alias;
    choice.probability = scene->lights[choice.light].probability;
    choice.rest = fmin(kept ? place / entry.threshold : (place - entry.threshold) / (1.0f - entry.threshold), 0x1.fffffep-1f);
    return choice;
}

#if LIGHT_TREE
// What rounding may take from the cosines: below them, down to minus this, light may still arrive.
#define COSINE_SLACK 1e-3f
// A child that can be seen at all is chosen with at least this chance, so that cuts of a word keep their precision.
#define LEAST_SHARE 1e-6f

// cos(max(0, a - b)) for angles in [0, pi].
static inline float cos_difference(float cos_a, float sin_a, float cos_b, float sin_b)
{
    return cos_a >= cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}

static inline float sine_of(float cosine)
{
    return sqrt(fmax(0.0f, 1.0f - cosine * cosine));
}

// A bound on the light that arrives, but for a factor that all nodes share [Conty Estevez and Kulla 2018, section 5.4].
// Zero only where none can.
static inline float light_importance(__global const LightNode* node, float3 position, uint horizon)
{
    const float3 to_center = unpack(node->center) - position;
    const float distance_squared = dot(to_center, to_center);
    const float radius_squared = node->radius * node->radius;
    // From within: 6 / r^2 is about the mean of 1 / d^2, at its centre, over a cube of half diagonal r.
    const float strength = fmin(node->intensity / fmax(fmax(distance_squared, radius_squared / 6.0f), 1e-30f), 1e30f);
    if (distance_squared <= radius_squared) return strength; // all around
    const float3 direction = to_center * rsqrt(distance_squared);
    // Of the angle under which the sphere is seen, and what exceeds it.
    const float sin2_around = radius_squared / distance_squared;
    const float cos_around = sqrt(1.0f - sin2_around), sin_around = sqrt(sin2_around);
    const float cos_axis = clamp(-dot(unpack(node->axis), direction), -1.0f, 1.0f);
    const float sin_axis = sine_of(cos_axis);
    const bool spread = cos_axis >= node->cos_spread;
    const float cos_beyond = spread ? 1.0f : cos_axis * node->cos_spread + sin_axis * node->sin_spread;
    const float sin_beyond = spread ? 0.0f : sin_axis * node->cos_spread - cos_axis * node->sin_spread;
    const float cos_leaving = cos_difference(cos_beyond, sin_beyond, cos_around, sin_around);
    if (cos_leaving < node->cos_reach - COSINE_SLACK) return 0.0f;
    float cos_arriving = 1.0f;
    if (horizon & HORIZON_HAS_NORMAL) {
        float cosine = clamp(dot(horizon_normal(horizon), direction), -1.0f, 1.0f);
        if (horizon & HORIZON_BOTH_SIDES) cosine = fabs(cosine);
        cos_arriving = cos_difference(cosine, sine_of(cosine), cos_around, sin_around);
        if (cos_arriving < -COSINE_SLACK) return 0.0f;
    }
    return strength * fmax(cos_leaving, COSINE_SLACK) * fmax(cos_arriving, COSINE_SLACK);
}

// The chance of a node's first child; negative where neither can be seen.
static inline float first_child_share(const SurfaceView* scene, __global const LightNode* node, float3 position, uint horizon)
{
    if (node->first_share >= 0.0f) return node->first_share;
    const float first = light_importance(scene->light_tree + node->first, position, horizon);
    const float second = light_importance(scene->light_tree + node->second, position, horizon);
    if (first == 0.0f && second == 0.0f) return -1.0f;
    if (first == 0.0f || second == 0.0f) return first == 0.0f ? 0.0f : 1.0f;
    return clamp(first / (first + second), LEAST_SHARE, 1.0f - LEAST_SHARE);
}

// Down the tree, narrowing an interval of words as in arithmetic coding: `place` is uniform in [0, range), and range is
// kept in [2^31, 2^32) by random bits that follow.
static inline LightChoice choose_light(const SurfaceView* scene, float3 position, uint horizon, uint word)
{
    uint range = 0xffffffffu, place = min(word, range - 1u), following = hash_uint(word);
    uint index = scene->globals->light_count;
    LightChoice choice = {NO_LIGHT, 1.0f, 0.0f};
    while (index >= scene->globals->light_count) {
        __global const LightNode* node = scene->light_tree + index;
        const float share = first_child_share(scene, node, position, horizon);
        if (share < 0.0f) return choice;
        const uint cut = share >= 1.0f ? range : (uint)(share * (float)range);
        const bool first = place < cut;
        place -= first ? 0u : cut;
        range = first ? cut : range - cut;
        choice.probability *= first ? share : 1.0f - share;
        index = first ? node->first : node->second;
        const uint shift = clz(range);
        place = (place << shift) | ((following >> 1) >> (31u - shift));
        following <<= shift;
        range <<= shift;
    }
    choice.light = index;
    choice.rest = fmin((float)place / (float)range, 0x1.fffffep-1f);
    return choice;
}

// The chance of choose_light() to choose a light: up the tree.
static inline float light_probability(const SurfaceView* scene, uint light, float3 position, uint horizon)
{
    uint index = light, parent = scene->light_tree[light].parent;
    if (parent == NO_NODE) return 0.0f;
    float probability = 1.0f;
    while (parent != NO_NODE) {
        __global const LightNode* node = scene->light_tree + parent;
        const float share = first_child_share(scene, node, position, horizon);
        if (share < 0.0f) return 0.0f;
        probability *= node->first == index ? share : 1.0f - share;
        index = parent;
        parent = node->parent;
    }
    return probability;
}
#else
static inline LightChoice choose_light(const SurfaceView* scene, float3 position, uint horizon, uint word)
{
    return choose_light_by_power(scene, word);
}

static inline float light_probability(const SurfaceView* scene, uint light, float3 position, uint horizon)
{
    return scene->lights[light].probability;
}
#endif

#endif
