// Photon relaxation [Spencer and Jones 2009, Computer Graphics Forum 28(2), Into the Blue: Better Caustics through Photon Relaxation]: an
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
    // Neighbours are at most so far away (scene units), and their directions have at least that cosine; -1: any.
    PhotonRelaxation(Device& device, float largest_radius, float least_cosine);

    // Moves the photons by so many sweeps, each from where all lay after the one before. Their flux, direction and number
    // stay as they are.
    void relax(std::vector<Photon>& photons, int sweeps);

private:
    Device& device_;
    float largest_radius_, least_cosine_;
    Kernel relax_photons_;
};

} // namespace sundog
