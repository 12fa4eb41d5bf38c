// One iteration of photon mapping up to the photon map: what progressive methods have in common.
#pragma once

#include "methods/bias_estimate.h"
#include "methods/light_pass.h"
#include "methods/method.h"
#include "stages/query_paths.h"

#include <optional>

namespace sundog
{

// camera paths -> queries; light paths -> photons -> map. Gathering, and what becomes of it, is the method's.
class PhotonPass
{
public:
    // finds_laplacians: the method estimates bias, where errors are asked for, by Laplacians that it needs anyway.
    PhotonPass(RenderContext& context, const Parameters& parameters, bool finds_laplacians = false);

    // Traces both kinds of paths and builds the map for queries of at most `radius`.
    void trace(std::uint64_t iteration, float radius);

    // To be called when the queries have the radii that they are answered with, before they are: adds the bias that their
    // estimate by the kernel (1 - t^2)^density_kernel has to the film's error estimate, where there is one.
    void estimate_bias(int density_kernel);

    // Before what pixels have learned changes.
    void begin_update() { context_.film.begin_update(); }

    // Sums by query, in `gather.sums`.
    template <class Result> void gather_photons(PhotonGather<Result>& gather) const
    {
        gather.gather(light_.map, queries.queries, queries.lobes, camera.count());
    }

    float first_radius() const { return first_radius_; }
    std::size_t light_paths() const { return light_.light_paths(); }
    float inverse_paths() const { return 1.0f / static_cast<float>(light_paths()); }
    std::size_t pixels() const { return camera.count(); }
    MethodCounters counters() const;
    void serialize(StateArchive& archive);

private:
    RenderContext& context_;
    float first_radius_;
    std::uint64_t iterations_ = 0;
    float radius_ = 0.0f; // of this iteration's queries at most
    LightPass light_;
    PathPool pool_;
    std::optional<BiasEstimate> bias_;

public:
    CameraPaths camera;
    QueryTracer queries;
};

} // namespace sundog
