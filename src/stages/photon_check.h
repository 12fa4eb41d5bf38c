// What a photon that comes from a file must be.
#pragma once

#include "math/plausible.h"
#include "math/bounds.h"
#include "shared/photon.h"

namespace sundog
{

constexpr float largest_photon = 1e24f; // W: products with counts and densities stay within a float

// Whether a render of a scene with these bounds can have left it. Relaxation moves some a little beyond them.
inline bool is_photon(const Photon& photon, const Bounds& bounds)
{
    const Vec3 extent = bounds.extent(), below = bounds.lower - extent, above = bounds.upper + extent, p = photon.position;
    const bool is_inside = p.x >= below.x && p.y >= below.y && p.z >= below.z && p.x <= above.x && p.y <= above.y && p.z <= above.z;
    return is_inside && is_plausible(photon.flux, largest_photon);
}

} // namespace sundog
