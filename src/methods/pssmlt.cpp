// Primary sample space Metropolis light transport [Kelemen et al. 2002, A Simple and Robust Mutation Strategy for the Metropolis
// Light Transport Algorithm, Computer Graphics Forum 21(3)]: Markov chains in the space of the random numbers that paths are made
// of visit numbers in proportion to what their paths bring to the film.
#include "methods/bidirectional.h"
#include "methods/primary_sample_metropolis.h"
#include "methods/standard_parameters.h"

namespace sundog
{
namespace
{

const MethodRegistration registration({
    .name = "pssmlt",
    .title = "Primary sample space Metropolis light transport",
    .paper = "Kelemen, Szirmay-Kalos, Antal and Csonka 2002, Computer Graphics Forum 21(3)",
    .estimator_class = "consistent",
    .description =
        "Thousands of Markov chains mutate the random numbers of paths, from the camera alone or bidirectional ones, and so stay where "
        "light is found. Smoother than path and bdpt where few paths find light; blind to what its paths cannot find.",
    .parameters = joined(
        {{"paths",
          ParameterType::choice,
          "bdpt",
          "",
          "What the numbers make: paths of `path`, or pairs of subpaths as those of `bdpt`.",
          0,
          0,
          {"path", "bdpt"}},
         max_depth_spec(),
         rr_depth_of_paths_spec(),
         light_choice_spec(),
         iterations_spec()},
        chain_specs()),
    .follows_motion = false,
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return make_primary_sample_metropolis(context, parameters);
    },
});

} // namespace
} // namespace sundog
