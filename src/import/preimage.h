// Values that a reader's arithmetic turns into wanted ones, bit for bit.
#pragma once

#include "math/vec3.h"

#include <limits>
#include <optional>

namespace sundog
{

// `guess` moved by `steps` floats, up or down.
inline float moved(float guess, int steps)
{
    for (; steps > 0; steps--) guess = std::nextafter(guess, std::numeric_limits<float>::infinity());
    for (; steps < 0; steps++) guess = std::nextafter(guess, -std::numeric_limits<float>::infinity());
    return guess;
}

// The float nearest to `guess`, and within a few of it, for which `good` holds: where a reader multiplies by a constant,
// what it read is that close to the quotient.
template <class Good> std::optional<float> find_near(float guess, Good good, int reach = 4)
{
    for (int distance = 0; distance <= reach; distance++)
        for (int steps : {distance, -distance})
            if (const float candidate = moved(guess, steps); good(candidate)) return candidate;
    return {};
}

// The same for a vector, of components within three floats of the guess's.
template <class Good> std::optional<Vec3> find_near(Vec3 guess, Good good)
{
    if (good(guess)) return guess;
    constexpr int reach = 3;
    for (int x = -reach; x <= reach; x++)
        for (int y = -reach; y <= reach; y++)
            for (int z = -reach; z <= reach; z++)
                if (const Vec3 candidate{moved(guess.x, x), moved(guess.y, y), moved(guess.z, z)}; good(candidate)) return candidate;
    return {};
}

} // namespace sundog
