// Vertex connection and merging [Georgiev, Krivanek, Davidovic and Slusallek 2012, ACM TOG 31(6)], found independently as
// unified path sampling [Hachisuka, Pantaleoni and Jensen 2012]: the same estimator, derived from another view of what a
// merge is. Bidirectional path tracing whose subpaths are also merged with photons nearby.
#include "methods/bidirectional.h"
#include "methods/parameters.h"

namespace sundog
{
namespace
{

ParameterSpec merging_spec()
{
    return {"merging", ParameterType::boolean, "true", "", "Merge vertices that lie close; without it this is bdpt, and radius, alpha and kernel mean nothing.", 0, 0, {}};
}

std::unique_ptr<Method> create(RenderContext& context, const Parameters& parameters)
{
    const JoinedBy joined_by = {has_connections(parameters), parameters.boolean("merging") ? PhotonUse::merged : PhotonUse::none};
    if (!joined_by.connections && joined_by.photons == PhotonUse::none)
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
    .parameters = joined(joined(joined(bidirectional_specs(), connection_specs({"own", "resampled", "none"})), merging_specs()),
                         {merging_spec()}),
    .create = create,
});

} // namespace
} // namespace sundog
