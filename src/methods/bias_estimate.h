// The bias of density estimates, iteration by iteration: mu_2 / 2 r^2 Delta L, with the radius and the kernel that the
// method used [Hachisuka, Jarosz and Jensen 2010], and the Laplacian by that of the triweight kernel. The variance
// of that Laplacian is as 1 / (N h^6): at the method's own radii, r_i ~ i^(-1/6), it would not vanish. So Laplacians have
// radii of their own, h_i ~ i^(-1/10), the optimal rate for second derivatives in the plane.
#pragma once

#include "methods/scene_gather.h"
#include "shared/adaptive_radius.h"
#include "stages/query_paths.h"

#include <string>

namespace sundog
{

// Radius of the Laplacians of an iteration, from 0.
float laplacian_radius(float first_radius, std::uint64_t iteration);

// mu_2 / 2 of a kernel on the unit disk, mu_2 being its second moment along an axis. density_kernel: as DENSITY_KERNEL.
double half_second_moment(int density_kernel);

// What the radiance was gathered with.
struct GatheredWith {
    int density_kernel = 0;     // as DENSITY_KERNEL
    float inverse_paths = 0.0f; // 1 / emitted light subpaths, times the query's share of its pixel
};

// Bias from Laplacians that are known. Sum: LaplacianSum, or ErrorSum where a method needs Laplacians itself. Adds to the
// film's error estimate, which there must be.
template <class Sum> class BiasTerm
{
public:
    explicit BiasTerm(RenderContext& context)
        : context_(context),
          add_bias_(context.device, "add_bias", "Add bias", {{{"LAPLACIAN_SUM", std::string(device_type_name<Sum>())}}, {}})
    {
    }

    // For queries with the radii that they are answered with.
    void add(const Buffer<GatherQuery>& queries, const Buffer<Sum>& laplacians, GatheredWith gathered_with)
    {
        const float half_moment = static_cast<float>(half_second_moment(gathered_with.density_kernel));
        add_bias_(laplacians.size(), queries, laplacians, static_cast<uint>(laplacians.size()), half_moment * gathered_with.inverse_paths,
                  context_.film.errors->bias);
    }

private:
    RenderContext& context_;
    Kernel add_bias_;
};

// Bias with Laplacians of its own.
class BiasEstimate
{
public:
    // first_radius: of queries in the first iteration (scene units).
    BiasEstimate(RenderContext& context, float first_radius);

    // For which radius (scene units) a map must be built whose queries ask for at most `radius` themselves. Iterations from 0.
    float map_radius(std::uint64_t iteration, float radius) const;

    // For queries with the radii that they are answered with, and their lobes.
    void add(const PhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, std::uint64_t iteration,
             GatheredWith gathered_with);

private:
    float first_radius_;
    Kernel widen_queries_;
    BiasTerm<LaplacianSum> term_;
    PhotonGather<LaplacianSum> laplacians_;
    Buffer<GatherQuery> wide_;
};

// The same for queries of the k nearest photons, by find_nearest_radii in dense maps. To leading order in 1 / k the bias is that of
// a fixed radius, mu_2 / 2 E[r_k^2] Delta L (1 - 1 / k).
class NearestBiasEstimate
{
public:
    NearestBiasEstimate(RenderContext& context, uint nearest);

    void add(const PhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, GatheredWith gathered_with);

private:
    float share_; // 1 - 1 / k
    Kernel widen_queries_;
    BiasTerm<LaplacianSum> term_;
    PhotonGather<LaplacianSum> laplacians_;
    Buffer<GatherQuery> wide_;
};

} // namespace sundog
