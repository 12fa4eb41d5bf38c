// Vertex connection and merging [Georgiev, Krivanek, Davidovic and Slusallek 2012, ACM TOG 31(6)], found independently as
// unified path sampling [Hachisuka, Pantaleoni and Jensen 2012]: the same estimator, derived from another view of what a
// merge is. Bidirectional path tracing whose subpaths are also merged with photons nearby.
#include "methods/bidirectional.h"
#include "methods/parameters.h"

namespace sundog
{
namespace
{

std::vector<ParameterSpec> specs()
{
    std::vector<ParameterSpec> specs = bidirectional_specs();
    const std::vector<ParameterSpec> merging = merging_specs();
    specs.insert(specs.end(), merging.begin(), merging.end());
    specs.push_back({"connections",
                     ParameterType::boolean,
                     "true",
                     "",
                     "Join subpaths by connections, next-event estimation and splats; without them this is bpm.",
                     0,
                     0,
                     {}});
    specs.push_back({"merging",
                     ParameterType::boolean,
                     "true",
                     "",
                     "Join subpaths by merging vertices that lie close; without it this is bdpt.",
                     0,
                     0,
                     {}});
    return specs;
}

std::unique_ptr<Method> create(RenderContext& context, const Parameters& parameters)
{
    const JoinedBy joined_by = {parameters.boolean("connections"), parameters.boolean("merging")};
    if (!joined_by.connections && !joined_by.merging)
        parameters.refuse("merging", "vcm cannot do without both connections and merging: nothing would join its subpaths");
    return make_bidirectional(context, parameters, joined_by);
}

const MethodRegistration registration({
    .name = "vcm",
    .title = "Vertex connection and merging",
    .paper = "Georgiev, Krivanek, Davidovic and Slusallek 2012, ACM TOG 31(6); Hachisuka, Pantaleoni and Jensen 2012, ACM TOG 31(6)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::none,
    .description = "Bidirectional path tracing and photon mapping under one set of weights: robust on every scene, from diffuse rooms to "
                   "caustics seen "
                   "through glass.",
    .parameters = specs(),
    .create = create,
});

} // namespace
} // namespace sundog
