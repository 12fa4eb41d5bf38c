// The iterations of `sundog render`.
#pragma once

#include "app/render_plan.h"

#include <exception>
#include <optional>

namespace sundog {

struct IterationsEnd {
    bool finished = false; // rather than interrupted, or ended by a failure
    bool error_met = false;
    std::exception_ptr failure; // of the last iteration, where there are others to save
};

// Iterates until a goal, a signal or a failure. Throws where not even one iteration is done: then there is nothing to save.
IterationsEnd iterate(RenderSession& session, const RenderPlan& plan, std::optional<LivePreview>& preview);

} // namespace sundog
