#include "stages/photon_relaxation.h"

namespace sundog
{

namespace
{

// More see structure better and smooth on a larger scale; the search for them costs the most.
constexpr int neighbours = 32;

} // namespace

PhotonRelaxation::PhotonRelaxation(Device& device, const Bounds& bounds, const Relaxation& relaxation)
    : device_(device), relaxation_(relaxation), map_(device, bounds),
      relax_photons_(device, "relax_photons", "Relax photons", BuildOptions{{{"NEIGHBOURS", std::to_string(neighbours) + "u"}}, {}})
{
}

void PhotonRelaxation::relax(std::vector<Photon>& photons, int sweeps)
{
    if (photons.empty()) return;
    RecordList<Photon> records(device_, "photons", photons.size());
    records.assign(photons);
    for (int sweep = 0; sweep < sweeps; sweep++) {
        map_.build_dense(records, photons.size(), relaxation_.first_radius);
        relax_photons_(photons.size(), map_.grid(), map_.cell_ends(), map_.cell_ends_offset(), map_.streams(), relaxation_,
                       static_cast<uint>(photons.size()), records.records());
    }
    photons = records.records().download(0, photons.size());
}

} // namespace sundog
