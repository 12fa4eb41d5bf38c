// Photon relaxation [Spencer and Jones 2009, ACM TOG 28(2), Into the Blue: Better Caustics through Photon Relaxation]: an
// operation on photons that are to make a map. They are moved apart until they lie evenly, which takes most of the noise
// from estimates of few photons; what noise there is of their own flux stays.
#pragma once

#include "device/kernel.h"
#include "shared/photon.h"
#include "shared/relaxation.h"
#include "stages/photon_map.h"

namespace sundog
{

class PhotonRelaxation
{
public:
    // bounds: of everything that photons lie on. relaxation: how neighbours are looked for.
    PhotonRelaxation(Device& device, const Bounds& bounds, const Relaxation& relaxation);

    // Moves the photons by so many sweeps, each from where all lay after the one before. Their flux, direction and number
    // stay as they are.
    void relax(std::vector<Photon>& photons, int sweeps);

private:
    Device& device_;
    Relaxation relaxation_;
    PhotonMap map_;
    Kernel relax_photons_;
};

} // namespace sundog
