// Progressive photon mapping, a probabilistic approach [Knaus and Zwicker 2011, ACM TOG 30(3)]: independent photon-mapping
// renders whose radius shrinks by a schedule, averaged. No statistics are kept from one to the next, so any kernel and any
// camera sampling will do: the reference among the progressive methods.
#include "methods/averaged_photon_mapping.h"
#include "methods/radius_policy.h"

namespace sundog
{
namespace
{

const MethodRegistration registration({
    .name = "pppm",
    .title = "Progressive photon mapping, a probabilistic approach",
    .paper = "Knaus and Zwicker 2011, ACM Transactions on Graphics 30(3)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Averages independent photon-mapping renders whose radius shrinks from one to the next. Renders caustics and light seen "
                   "through glass; "
                   "the reference among the progressive methods.",
    .parameters = averaged_specs("epanechnikov", "schedule"),
    .create = make_averaged_photon_mapping,
});

} // namespace
} // namespace sundog
