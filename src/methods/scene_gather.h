// Gathering that fits a scene.
#pragma once

#include "methods/render_context.h"
#include "stages/photon_gather.h"

#include <optional>
#include <string>

namespace sundog
{

// Surface options of queries' lobes, where the scene has lobes to evaluate.
inline std::optional<BuildOptions> gathered_lobes(const RenderContext& context)
{
    return context.scene.has_lobes_to_evaluate() ? std::optional(context.scene.surface_options()) : std::nullopt;
}

// What answers queries of a scene, with an estimator (kernels/estimators) and a kernel (1 - t^2)^density_kernel.
template <class Result = GatherSum>
PhotonGather<Result> make_gather(RenderContext& context, const std::string& estimator, int density_kernel = 0)
{
    return {context.device, context.film.pixel_count(), estimator, density_kernel, gathered_lobes(context)};
}

} // namespace sundog
