#include "stages/precomputed_irradiance.h"

#include <algorithm>

namespace sundog
{

namespace
{

constexpr std::size_t photons_a_place = 4; // Christensen's choice

// Puts the irradiance that the map has at `places` into their flux.
void compute_irradiance(Device& device, FixedPhotonMap& map, std::vector<Photon>& places)
{
    const Kernel query_photons(device, "query_photons", "Query photons");
    const Buffer<Photon> photons(device, places, "irradiance places");
    const Buffer<LobeRecord> no_lobes(device, 1, "query lobes");
    const std::size_t batch = map.capacity();
    Buffer<GatherQuery> queries(device, batch, "irradiance queries");
    Buffer<Vec3> irradiance(device, batch, "irradiance");
    for (std::size_t first = 0; first < places.size(); first += batch) {
        irradiance.upload(std::vector<Vec3>(batch, {0, 0, 0}));
        query_photons(batch, photons, static_cast<uint>(first), static_cast<uint>(places.size()), map.lookup().radius,
                      static_cast<uint>(batch), queries);
        map.add_radiance(queries, no_lobes, irradiance);
        const std::vector<Vec3> values = irradiance.download(0, std::min(batch, places.size() - first));
        for (std::size_t i = 0; i < values.size(); i++) places[first + i].flux = values[i];
    }
}

} // namespace

PrecomputedIrradiance::PrecomputedIrradiance(Device& device, const DeviceScene& scene, const std::vector<Photon>& photons,
                                             FixedPhotonMap& map)
    : radius_(map.lookup().radius), places_(device, scene.bounds()), read_irradiance_(device, "read_irradiance", "Read irradiance")
{
    std::vector<Photon> places;
    for (std::size_t i = 0; i < photons.size(); i += photons_a_place) places.push_back(photons[i]);
    if (!places.empty()) compute_irradiance(device, map, places);
    RecordList<Photon> records(device, "irradiance places", std::max<std::size_t>(places.size(), 1));
    records.assign(places);
    places_.build(records, places.size(), radius_);
    device.finish(); // the records go
}

void PrecomputedIrradiance::answer(Buffer<GatherQuery>& queries, Buffer<Vec3>& radiance)
{
    read_irradiance_(queries.size(), places_, radius_,
                     static_cast<uint>(queries.size()), queries, radiance);
}

} // namespace sundog
