#include "methods/bias_estimate.h"

#include <algorithm>
#include <cmath>

namespace sundog
{

namespace
{

// First radius of Laplacians as a multiple of the method's own. The variance of the bias relative to that of the estimate
// is (mu_2 / 2)^2 97.8 / (R (h / r)^6): at 2 less than a tenth, for the uniform kernel, and less for others.
constexpr double wide_disk = 2.0;
// No Laplacian is estimated from a disk narrower than this, even where a radius does not shrink: at 1.5 the bias of the
// uniform kernel has two fifths of the estimate's variance.
constexpr float narrowest_disk = 1.5f;

} // namespace

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
    return std::max(laplacian_radius(first_radius_, iteration), narrowest_disk * radius);
}

void BiasEstimate::add(const PhotonMap& map, const QueryTracer& queries, std::uint64_t iteration, GatheredWith gathered_with)
{
    const std::size_t count = wide_.size();
    widen_queries_(count, queries.queries, static_cast<uint>(count), laplacian_radius(first_radius_, iteration), narrowest_disk, wide_);
    laplacians_.gather(map, wide_, queries.lobes, count);
    term_.add(queries.queries, laplacians_.sums, gathered_with);
}

} // namespace sundog
