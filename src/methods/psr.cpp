// Path space regularization [Kaplanyan and Dachsbacher 2013, Path Space Regularization for Holistic and Robust Light Transport, Computer
// Graphics Forum 32(2)]: path tracing that also finds light of points and directions behind specular surfaces, their one direction
// being mollified to a cone that narrows from iteration to iteration.
#include "methods/bidirectional.h"
#include "methods/path_tracing.h"

namespace sundog
{
namespace
{

ParameterSpec paths_spec()
{
    return {"paths", ParameterType::choice, "path", "",
            "What is regularized: path tracing, or bidirectional path tracing where none of its techniques finds a path.", 0, 0, {"path", "bdpt"}};
}

void refuse_light_subpaths(const Parameters& parameters)
{
    for (const char* name : {"photons", "connections", "picks"})
        if (parameters.is_set(name)) parameters.refuse(name, std::string(name) + " is for light subpaths; use -p paths=bdpt");
}

std::unique_ptr<Method> create(RenderContext& context, const Parameters& parameters)
{
    const RegularizationSchedule schedule(parameters);
    if (parameters.text("paths") == "bdpt") return make_bidirectional(context, parameters, {true, PhotonUse::none}, schedule);
    refuse_light_subpaths(parameters);
    return make_path_tracing(context, parameters, schedule);
}

const MethodRegistration registration({
    .name = "psr",
    .title = "Path space regularization",
    .paper = "Kaplanyan and Dachsbacher 2013, Computer Graphics Forum 32(2)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::none,
    .description = "Path tracing that finds the light of points and directions in mirrors and through glass too, by mollifying specular directions "
                   "less and less. Where path is black and lamps have no area; lamps that have one it treats as path does.",
    .parameters = joined(joined(joined({paths_spec()}, RegularizationSchedule::specs()), bidirectional_specs()), connection_specs({"own", "resampled"})),
    .create = create,
});

} // namespace
} // namespace sundog
