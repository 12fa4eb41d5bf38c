// Path tracing [Kajiya 1986] with next-event estimation and BSDF sampling under multiple importance sampling
// [Veach and Guibas 1995]. Unbiased, but blind to caustics of small lights.
#include "methods/path_tracing.h"
#include "methods/standard_parameters.h"

namespace sundog {
namespace {

const MethodRegistration registration({
    .name = "path",
    .title = "Path tracing",
    .paper = "Kajiya 1986, SIGGRAPH; Veach and Guibas 1995, SIGGRAPH",
    .estimator_class = "unbiased",
    .error_model = ErrorModel::variance,
    .description = "Paths from the camera with next-event estimation and BSDF sampling under multiple importance sampling. Best for diffuse scenes with "
                   "large lights; cannot find small lights through glass.",
    .parameters = {max_depth_spec(), rr_depth_spec(rr_depth_of_paths, "paths, by throughput"), sampler_spec(), light_choice_spec(), spectral_spec(), iterations_spec()},
    .traces_light = false,
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> { return make_path_tracing(context, parameters, {}); },
});

} // namespace
} // namespace sundog
