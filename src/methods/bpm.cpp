// Bidirectional photon mapping [Vorba 2011, CESCG]: photons are looked for at every vertex of a camera path, weighted
// against looking at the others.
#include "methods/bidirectional.h"
#include "methods/parameters.h"

namespace sundog
{
namespace
{

const MethodRegistration registration({
    .name = "bpm",
    .title = "Bidirectional photon mapping",
    .paper = "Vorba 2011, Central European Seminar on Computer Graphics",
    .estimator_class = "consistent",
    .error_model = ErrorModel::none,
    .description =
        "Merges photons at every vertex of the camera's path, weighted by the balance heuristic: vcm without connections. Does for glossy "
        "surfaces what final gathering does for diffuse ones.",
    .parameters = joined(bidirectional_specs(), merging_specs()),
    .create =
        [](RenderContext& context, const Parameters& parameters) {
            return make_bidirectional(context, parameters, {false, PhotonUse::merged});
        },
});

} // namespace
} // namespace sundog
