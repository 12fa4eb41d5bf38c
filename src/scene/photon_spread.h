// How thinly photons of distant lights lie on what the camera sees. They set out from a disk as large as the sphere around the scene, so
// that a ground of a kilometre leaves few for a table on it.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace sundog
{

// Of the disk's area, what the half of the pixels shows that shows the least: between 0 and 1. Directions of the light and what stands
// in its way are left out, so that it is at most so much. By a fixed grid of rays from the middle of the lens to the first
// surface. They pass through instances. Nothing without distant lights, and where few of the rays meet anything.
std::optional<double> share_of_distant_photons(const Scene& scene);

// A line that says so where fewer than one photon in a thousand is used, with the figure and what to do.
std::optional<std::string> warn_of_spread_photons(const Scene& scene);

} // namespace sundog
