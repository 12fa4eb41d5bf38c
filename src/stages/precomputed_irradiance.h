// Irradiance computed ahead at a part of the photons, for final gathers to look up [Christensen 1999, Faster Photon Map Global
// Illumination].
#pragma once

#include "stages/fixed_photon_map.h"

namespace sundog
{

class PrecomputedIrradiance
{
public:
    // At every fourth of the photons, whose map `map` is.
    PrecomputedIrradiance(Device& device, const DeviceScene& scene, const std::vector<Photon>& photons, FixedPhotonMap& map);

    // radiance[i] += what query i finds, where it is at a diffuse lobe and the nearest place within the map's radius has a
    // similar normal; such queries have no radius any more.
    void answer(Buffer<GatherQuery>& queries, Buffer<Vec3>& radiance);

private:
    float radius_;
    PhotonMap places_;
    Kernel read_irradiance_;
};

} // namespace sundog
