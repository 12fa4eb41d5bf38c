// Path tracing [Kajiya 1986] with next-event estimation and BSDF sampling under multiple importance sampling
// [Veach and Guibas 1995].
#pragma once

#include "methods/method.h"
#include "methods/regularization_schedule.h"

#include <optional>

namespace sundog
{

// schedule: of what specular vertices before a light add; none: nothing.
std::unique_ptr<Method> make_path_tracing(RenderContext& context, const Parameters& parameters, std::optional<RegularizationSchedule> schedule);

} // namespace sundog
