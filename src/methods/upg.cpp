// Unbiased photon gathering [Qin, Sun, Hou, Guo and Zhou 2015, Unbiased Photon Gathering for Light Transport Simulation, ACM
// TOG 34(6)]: bidirectional path tracing whose camera subpaths also connect to photons near the surface that they would have
// gone on from, divided by the probability to come as near.
#include "methods/bidirectional.h"
#include "methods/standard_parameters.h"

namespace sundog
{
namespace
{

ParameterSpec gathering_radius_spec()
{
    ParameterSpec radius = radius_spec();
    radius.description = "How near photons are gathered; it does not shrink, and changes noise and time alone. 0: a pixel, or less where light "
                         "subpaths are many.";
    return radius;
}

const MethodRegistration registration({
    .name = "upg",
    .title = "Unbiased photon gathering",
    .paper = "Qin, Sun, Hou, Guo and Zhou 2015, ACM TOG 34(6)",
    .estimator_class = "unbiased",
    .error_model = ErrorModel::variance,
    .description = "Bidirectional path tracing that also finds light as photon mapping does, by photons near a surface, but without its blur. For "
                   "glossy reflections of caustics; specular ones only vcm and the photon methods find.",
    .parameters = joined(joined(bidirectional_specs(), connection_specs({"own", "resampled"})), {gathering_radius_spec()}),
    .create =
        [](RenderContext& context, const Parameters& parameters) {
            return make_bidirectional(context, parameters, {true, PhotonUse::gathered});
        },
});

} // namespace
} // namespace sundog
