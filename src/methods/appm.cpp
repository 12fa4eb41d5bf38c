// Adaptive progressive photon mapping [Kaplanyan and Dachsbacher 2013, ACM TOG 32(2)]: every pixel learns bias and variance of
// its estimates (adaptive_radii.cpp) and chooses its radius by them.
#include "methods/averaged_photon_mapping.h"
#include "methods/radius_policy.h"

namespace sundog
{
namespace
{

const MethodRegistration registration({
    .name = "appm",
    .title = "Adaptive progressive photon mapping",
    .paper = "Kaplanyan and Dachsbacher 2013, ACM Transactions on Graphics 32(2)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Every pixel learns bias and variance of its estimates and chooses the radius that balances them, at most that of the "
                   "global schedule. "
                   "`radius` is the largest: choose it wide.",
    .parameters = averaged_specs("epanechnikov", "adaptive"),
    .create = make_averaged_photon_mapping,
});

} // namespace
} // namespace sundog
