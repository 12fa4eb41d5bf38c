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

// What photons are moved for: to be as far from each other as light is even, or to have as much flux as their neighbours.
enum class RelaxedTo { even_spacing, equal_flux };

class PhotonRelaxation
{
public:
    // Neighbours are at most so far away (scene units), and their directions have at least that cosine; -1: any.
    PhotonRelaxation(Device& device, float largest_radius, float least_cosine, RelaxedTo relaxed_to = RelaxedTo::even_spacing);

    // Moves the photons by so many sweeps, each from where all lay after the one before, and each by `step` of the way. Their
    // flux, direction and number stay as they are.
    void relax(std::vector<Photon>& photons, int sweeps, float step = 1.0f);

private:
    Device& device_;
    float largest_radius_, least_cosine_;
    Kernel relax_photons_;
};

Bounds bounds_of(const std::vector<Photon>& photons);

// Holds so many of the photons where they lie evenly on the largest side of their bounds. They are denser, mostly. At most, and for
// photons along an axis or in one place, `largest`.
float radius_of_photons(const Bounds& bounds, std::size_t photons, double held, float largest);

} // namespace sundog
