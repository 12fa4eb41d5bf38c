// One iteration of photon mapping up to the photon map: what progressive methods have in common.
#pragma once

#include "methods/light_pass.h"
#include "methods/method.h"
#include "stages/photon_gather.h"
#include "stages/query_paths.h"

namespace sundog
{

// What answers queries of a scene, with an estimator (kernels/estimators) and a kernel (1 - t^2)^density_kernel.
template <class Result = GatherSum>
PhotonGather<Result> make_gather(RenderContext& context, const std::string& estimator, int density_kernel = 0)
{
    return {context.device, context.film.pixel_count(), estimator, density_kernel,
            context.scene.has_lobes_to_evaluate() ? std::optional(context.scene.surface_options()) : std::nullopt};
}

// camera paths -> queries; light paths -> photons -> map. Gathering, and what becomes of it, is the method's.
class PhotonPass
{
public:
    PhotonPass(RenderContext& context, const Parameters& parameters);

    // Traces both kinds of paths and builds the map for queries of at most `radius`.
    void trace(std::uint64_t iteration, float radius);

    // Sums by query, in `gather.sums`.
    template <class Result> void gather_photons(PhotonGather<Result>& gather) const
    {
        gather.gather(light_.map, queries.queries, queries.lobes, camera.count());
    }

    float first_radius() const { return first_radius_; }
    std::size_t light_paths() const { return light_.light_paths(); }
    std::size_t pixels() const { return camera.count(); }
    MethodCounters counters() const;
    void serialize(StateArchive& archive);

private:
    RenderContext& context_;
    float first_radius_;
    std::uint64_t iterations_ = 0;
    LightPass light_;
    PathPool pool_;

public:
    CameraPaths camera;
    QueryTracer queries;
};

} // namespace sundog
