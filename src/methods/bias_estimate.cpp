#include "methods/bias_estimate.h"

#include "shared/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace sundog
{

namespace
{

// First radius of Laplacians as a multiple of the method's own. The variance of the bias relative to that of the estimate
// is (mu_2 / 2)^2 97.8 / (R (h / r)^6): at 2 less than a tenth, for the uniform kernel, and less for others.
constexpr double wide_disk = 2.0;

} // namespace

double half_second_moment(int density_kernel)
{
    constexpr int cone = 4, gaussian = 5; // kernels/density/kernels.h
    if (density_kernel == cone) {
        constexpr double c = 1.1;
        return 0.5 * (1.0 / 4 - 1.0 / (5 * c)) / (1.0 - 2.0 / (3 * c));
    }
    if (density_kernel == gaussian) {
        // Means of the shape and of t^2 times the shape over the disk, by integrals of t exp(-b t^2) and t^3 exp(-b t^2).
        constexpr double beta = 1.953, b = 0.5 * beta;
        const double end = std::exp(-b), ends = 1.0 - std::exp(-beta);
        const double mean = 1.0 - (1.0 - (1.0 - end) / b) / ends, second = 0.5 - (0.5 - (1.0 - end * (1.0 + b)) / (b * b)) / ends;
        return 0.25 * second / mean;
    }
    return 0.25 / (density_kernel + 2.0);
}

float laplacian_radius(float first_radius, std::uint64_t iteration)
{
    return static_cast<float>(wide_disk * first_radius * std::pow(static_cast<double>(iteration) + 1.0, -0.1));
}

BiasEstimate::BiasEstimate(RenderContext& context, float first_radius)
    : first_radius_(first_radius), widen_queries_(context.device, "widen_queries", "Widen queries"), term_(context),
      laplacians_(make_gather<LaplacianSum>(context, "estimators/laplacian.h")),
      wide_(context.device, context.film.pixel_count(), "wide queries")
{
}

float BiasEstimate::map_radius(std::uint64_t iteration, float radius) const
{
    return std::max(laplacian_radius(first_radius_, iteration), NARROWEST_LAPLACIAN * radius);
}

void BiasEstimate::add(const PhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes, std::uint64_t iteration,
                       GatheredWith gathered_with)
{
    const std::size_t count = wide_.size();
    widen_queries_(count, queries, static_cast<uint>(count), laplacian_radius(first_radius_, iteration), NARROWEST_LAPLACIAN, wide_);
    laplacians_.gather(map, wide_, lobes, count);
    term_.add(queries, laplacians_.sums, gathered_with);
}

NearestBiasEstimate::NearestBiasEstimate(RenderContext& context, uint nearest)
    : share_(1.0f - 1.0f / static_cast<float>(nearest)), widen_queries_(context.device, "widen_queries", "Widen queries"), term_(context),
      laplacians_(context.device, context.film.pixel_count(), "estimators/nearest_laplacian.h", 0, gathered_lobes(context), true),
      wide_(context.device, context.film.pixel_count(), "wide queries")
{
}

void NearestBiasEstimate::add(const PhotonMap& map, const Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes,
                              GatheredWith gathered_with)
{
    const std::size_t count = wide_.size();
    widen_queries_(count, queries, static_cast<uint>(count), 0.0f, NARROWEST_LAPLACIAN, wide_);
    laplacians_.gather(map, wide_, lobes, count);
    gathered_with.inverse_paths *= share_;
    term_.add(queries, laplacians_.sums, gathered_with);
}

} // namespace sundog
