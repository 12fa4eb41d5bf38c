// Parameters of photonmapper that do not go together.
#pragma once

#include "methods/parameters.h"

namespace sundog
{

// Throws what a wrong value throws, naming both parameters. estimates_errors: whether the render is asked for them.
void refuse_conflicts_of_photon_maps(const Parameters& parameters, bool estimates_errors);

} // namespace sundog
