// Path space regularization [Kaplanyan and Dachsbacher 2013, Path Space Regularization for Holistic and Robust Light Transport, Computer
// Graphics Forum 32(2)]: path tracing that also finds light of points and directions behind specular surfaces, their one direction
// being mollified to a cone that narrows from iteration to iteration.
#include "methods/bidirectional.h"
#include "methods/path_tracing.h"
#include "methods/primary_sample_metropolis.h"
#include "methods/standard_parameters.h"

namespace sundog
{
namespace
{

ParameterSpec paths_spec()
{
    return {"paths", ParameterType::choice, "path", "",
            "path: path tracing; bdpt: bidirectional path tracing, of which only paths that none of its techniques finds are regularized; pssmlt: the "
            "paths of path, made by Markov chains.",
            0, 0, {"path", "bdpt", "pssmlt"}};
}

// Parameters that mean something for one choice of `paths` alone.
void refuse_parameters_of_others(const Parameters& parameters)
{
    const std::string paths = parameters.text("paths");
    const auto belongs_to = [&](const char* owner, const char* what, std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (paths != owner && parameters.is_set(name)) parameters.refuse(name, std::string(name) + " is for " + what + "; use -p paths=" + owner);
    };
    belongs_to("bdpt", "light subpaths", {"photons", "connections", "picks"});
    belongs_to("pssmlt", "Markov chains", {"chains", "large_step", "seeds"});
    if (paths != "pssmlt") return;
    for (const char* name : {"sampler", "spectral"})
        if (parameters.is_set(name)) parameters.refuse(name, std::string("Markov chains have no ") + name + "; use -p paths=path or bdpt");
}

std::unique_ptr<Method> create(RenderContext& context, const Parameters& parameters)
{
    refuse_parameters_of_others(parameters);
    const RegularizationSchedule schedule(parameters);
    if (parameters.text("paths") == "pssmlt") return make_primary_sample_metropolis(context, parameters, schedule);
    if (parameters.text("paths") == "bdpt") return make_bidirectional(context, parameters, {true, PhotonUse::none}, schedule);
    return make_path_tracing(context, parameters, schedule);
}

const MethodRegistration registration({
    .name = "psr",
    .title = "Path space regularization",
    .paper = "Kaplanyan and Dachsbacher 2013, Computer Graphics Forum 32(2)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::none,
    .description = "Path tracing that finds the light of points and directions in mirrors and through glass too, where path renders black, by "
                   "mollifying specular directions less and less. Light of lamps with an area it finds as path does.",
    .parameters = joined(joined(joined({paths_spec(), photons_spec(), max_depth_spec(), rr_depth_of_paths_spec(), sampler_spec(), spectral_spec(),
                                        iterations_spec()},
                                       RegularizationSchedule::specs()),
                                connection_specs({"own", "resampled"})),
                         chain_specs()),
    .motion_excludes = {{"paths", "pssmlt"}},
    .create = create,
});

} // namespace
} // namespace sundog
