// Chi-squared progressive photon mapping [Lin, Li, Zeng, Zhang, Jia, Wang and Manocha 2020, ACM TOG 39(6)]: a pixel keeps
// its radius while its photons lie evenly (chi_squared_radii.cpp). Estimates are averaged as they are, each by its own radius:
// what was gathered with a wide radius before a test failed stays, and its share vanishes.
#include "methods/averaged_photon_mapping.h"
#include "methods/radius_policy.h"

namespace sundog
{
namespace
{

const MethodRegistration registration({
    .name = "cppm",
    .title = "Chi-squared progressive photon mapping",
    .paper = "Lin, Li, Zeng, Zhang, Jia, Wang and Manocha 2020, ACM Transactions on Graphics 39(6)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Every pixel tests whether the photons it finds lie evenly, and shrinks its radius only where they do not. Keeps wide "
                   "radii, and so little "
                   "noise, where light is even.",
    .parameters = averaged_specs("uniform", "chi_squared"),
    .create = make_averaged_photon_mapping,
});

} // namespace
} // namespace sundog
