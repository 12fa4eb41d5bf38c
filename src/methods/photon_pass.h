// One iteration of photon mapping up to the photon map: what progressive methods have in common.
#pragma once

#include "methods/method.h"
#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/light_paths.h"
#include "stages/photon_gather.h"
#include "stages/query_paths.h"

namespace sundog {

// camera paths -> queries; light paths -> photons -> map. Gathering, and what becomes of it, is the method's.
class PhotonPass {
public:
    PhotonPass(RenderContext& context, const Parameters& parameters);

    // Traces both kinds of paths and builds the map for queries of at most `radius`.
    void trace(std::uint64_t iteration, float radius);

    // What answers the queries, with an estimator (kernels/estimators) and a kernel (1 - t^2)^density_kernel.
    template <class Result = GatherSum> PhotonGather<Result> make_gather(const std::string& estimator, int density_kernel = 0) const
    {
        return {context_.device, camera.count(), estimator, density_kernel,
                context_.scene.has_lobes_to_evaluate() ? std::optional(context_.scene.surface_options()) : std::nullopt};
    }

    // Sums by query, in `gather.sums`.
    template <class Result> void gather_photons(PhotonGather<Result>& gather) const { gather.gather(map, queries.queries, queries.lobes, camera.count()); }

    float first_radius() const { return first_radius_; }
    std::size_t light_paths() const { return light_paths_; }
    std::size_t pixels() const { return camera.count(); }
    MethodCounters counters() const;
    void serialize(StateArchive& archive);

private:
    RenderContext& context_;
    std::size_t light_paths_;
    float first_radius_;
    std::uint64_t iterations_ = 0;
    std::uint64_t photons_stored_ = 0;
    PathPool pool_;
    PhotonTracer photons_;

public:
    CameraPaths camera;
    QueryTracer queries;
    PhotonMap map;
};

} // namespace sundog
