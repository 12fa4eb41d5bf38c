// Methods whose image is the mean of photon-mapping renders, each with radii that earlier ones have taught: they differ by
// their radius policy alone.
#pragma once

#include "methods/method.h"

namespace sundog
{

// With the parameters of averaged_specs() (methods/radius_policy.h), or more.
std::unique_ptr<Method> make_averaged_photon_mapping(RenderContext& context, const Parameters& parameters);

} // namespace sundog
