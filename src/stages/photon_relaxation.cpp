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

Bounds bounds_of(const std::vector<Photon>& photons)
{
    Bounds bounds;
    for (const Photon& photon : photons) bounds.extend(photon.position);
    return bounds;
}

// Holds half of the neighbours where photons lie evenly on the largest side of their bounds. They are denser, mostly.
float usual_radius(const Bounds& bounds, std::size_t photons)
{
    const Vec3 e = bounds.extent();
    const double side = std::max({static_cast<double>(e.x) * e.y, static_cast<double>(e.y) * e.z, static_cast<double>(e.z) * e.x});
    return static_cast<float>(std::sqrt(0.5 * neighbours * side / (std::numbers::pi * static_cast<double>(photons))));
}

} // namespace

PhotonRelaxation::PhotonRelaxation(Device& device, float largest_radius, float least_cosine)
    : device_(device), largest_radius_(largest_radius), least_cosine_(least_cosine),
      relax_photons_(device, "relax_photons", "Relax photons", BuildOptions{{{"NEIGHBOURS", std::to_string(neighbours) + "u"}}, {}})
{
}

void PhotonRelaxation::relax(std::vector<Photon>& photons, int sweeps)
{
    if (photons.empty()) return;
    RecordList<Photon> records(device_, "photons", photons.size());
    records.assign(photons);
    const Bounds bounds = bounds_of(photons);
    PhotonMap map(device_, bounds); // which photons may leave, by little: then they lie in its outermost cells
    const Relaxation relaxation{std::min(usual_radius(bounds, photons.size()), largest_radius_), largest_radius_, least_cosine_};
    for (int sweep = 0; sweep < sweeps; sweep++) {
        map.build_dense(records, photons.size(), relaxation.first_radius);
        relax_photons_(photons.size(), map.grid(), map.cell_ends(), map.cell_ends_offset(), map.streams(), relaxation,
                       static_cast<uint>(photons.size()), records.records());
    }
    photons = records.records().download(0, photons.size());
}

} // namespace sundog
