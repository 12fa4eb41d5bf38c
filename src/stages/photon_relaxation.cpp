#include "stages/photon_relaxation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

// More see structure better and smooth on a larger scale; the search for them costs the most.
constexpr int neighbours = 32;

BuildOptions options_for(RelaxedTo relaxed_to)
{
    BuildOptions options{{{"NEIGHBOURS", std::to_string(neighbours) + "u"}}, {}};
    if (relaxed_to == RelaxedTo::equal_flux) options.defines.emplace_back("EQUAL_FLUX", "1");
    return options;
}

} // namespace

Bounds bounds_of(const std::vector<Photon>& photons)
{
    Bounds bounds;
    for (const Photon& photon : photons) bounds.extend(photon.position);
    return bounds;
}

float radius_of_photons(const Bounds& bounds, std::size_t photons, double held, float largest)
{
    const Vec3 e = bounds.extent();
    const double side = std::max({static_cast<double>(e.x) * e.y, static_cast<double>(e.y) * e.z, static_cast<double>(e.z) * e.x});
    const float radius = static_cast<float>(std::sqrt(held * side / (std::numbers::pi * static_cast<double>(photons))));
    return radius > 0.0f ? std::min(radius, largest) : largest;
}

PhotonRelaxation::PhotonRelaxation(Device& device, float largest_radius, float least_cosine, RelaxedTo relaxed_to)
    : device_(device), largest_radius_(largest_radius), least_cosine_(least_cosine),
      relax_photons_(device, "relax_photons", "Relax photons", options_for(relaxed_to))
{
}

void PhotonRelaxation::relax(std::vector<Photon>& photons, int sweeps, float step)
{
    if (photons.empty()) return;
    RecordList<Photon> records(device_, "photons", photons.size());
    records.assign(photons);
    const Bounds bounds = bounds_of(photons);
    PhotonMap map(device_, bounds); // which photons may leave, by little: then they lie in its outermost cells
    const Relaxation relaxation{radius_of_photons(bounds, photons.size(), 0.5 * neighbours, largest_radius_), largest_radius_,
                                least_cosine_, step};
    for (int sweep = 0; sweep < sweeps; sweep++) {
        map.build_dense(records, photons.size(), relaxation.first_radius);
        relax_photons_(photons.size(), map, relaxation,
                       static_cast<uint>(photons.size()), records.records());
    }
    photons = records.records().download(0, photons.size());
}

} // namespace sundog
