// Progressive photon relaxation [Spencer and Jones 2013, ACM TOG 32(1)]: an operation on the photons of many passes that are to make
// one map. Those of the first pass, the primal ones, stay, and take up the flux of all that follow; so the map does not grow
// with the passes, and its noise falls. They move until each has as much flux as its neighbours.
#pragma once

#include "base/state_archive.h"
#include "math/double3.h"
#include "stages/photon_relaxation.h"

namespace sundog
{

class ProgressiveRelaxation
{
public:
    // A photon's flux goes to a primal one at most so far away (scene units), whose direction has at least that cosine; -1: any.
    ProgressiveRelaxation(Device& device, float largest_radius, float least_cosine);

    // Takes up the photons of another pass, as many light subpaths strong as the others, and moves all by a sweep. Each photon's
    // flux goes to the nearest primal photon of its side of the surface. One that finds none becomes a primal photon itself.
    void add_pass(const std::vector<Photon>& photons);

    // The primal photons, with the flux that came to each in the mean of the passes: a map as strong as one pass.
    const std::vector<Photon>& photons() const { return primal_; }

    std::uint64_t passes() const { return passes_; }
    void serialize(StateArchive& archive, const Bounds& bounds); // of the scene

private:
    std::vector<uint> nearest_primal(const std::vector<Photon>& photons);

    Device& device_;
    float largest_radius_, least_cosine_;
    PhotonRelaxation relaxation_;
    Kernel find_nearest_photons_;
    std::vector<Photon> primal_;
    std::vector<Double3> sums_; // of the flux that came to each
    std::uint64_t passes_ = 0;
};

} // namespace sundog
