// Bidirectional path tracing [Veach and Guibas 1995, SIGGRAPH; Lafortune and Willems 1993, Compugraphics]: the camera's
// and the light's subpath of a pixel are connected at all pairs of their vertices.
#include "methods/bidirectional.h"

namespace sundog
{
namespace
{

const MethodRegistration registration({
    .name = "bdpt",
    .title = "Bidirectional path tracing",
    .paper = "Veach and Guibas 1995, SIGGRAPH; Lafortune and Willems 1993, Compugraphics",
    .estimator_class = "unbiased",
    .error_model = ErrorModel::variance,
    .description =
        "Connects subpaths from the camera and from the lights in every way, weighted by the balance heuristic. For light that comes round "
        "corners and for caustics seen directly; blind to caustics seen in mirrors or through glass.",
    .parameters = joined(bidirectional_specs(), connection_specs({"own", "resampled"})),
    .create =
        [](RenderContext& context, const Parameters& parameters) {
            return make_bidirectional(context, parameters, {true, PhotonUse::none});
        },
});

} // namespace
} // namespace sundog
