// What `sundog render` leaves: checkpoint, images and statistics.
#pragma once

#include "app/render_loop.h"
#include "base/timer.h"

namespace sundog {

// Saves all that can be saved, the checkpoint first: hours of rendering must not be lost to one full disk, nor to memory
// that does not suffice for the image. Then throws the first failure, that of the iterations before any other.
void save_results(const RenderSession& session, const RenderOptions& options, const RenderPlan& plan, const IterationsEnd& end,
                  std::optional<LivePreview>& preview, const Timer& wall);

} // namespace sundog
