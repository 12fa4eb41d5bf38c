// Unbiased photon gathering [Qin, Sun, Hou, Guo and Zhou 2015, ACM TOG 34(6)]: a photon near the surface that a camera subpath
// has found takes that surface's place. The vertex before it is connected to the photon's own vertex, and the result is divided
// by the probability to come as near, which Bernoulli trials estimate without bias.
#pragma once

#include "stages/bernoulli_trials.h"
#include "stages/near_photons.h"

namespace sundog
{

class UnbiasedGathering
{
public:
    // paths: of the camera.
    UnbiasedGathering(Device& device, const DeviceScene& scene, std::size_t paths, PathRules rules);

    // Sorts the photons of traced light subpaths.
    void build(const LightSubpaths& light, float radius) { near_.build(light, radius); }

    // Gathers at the hits of this bounce, before they are shaded, and adds what that brings to the radiance of their paths.
    void gather(const DeviceScene& scene, const ConnectedSubpaths& subpaths, Buffer<Vec3>& radiance);

    std::uint64_t trials() const { return trials_.trials(); } // traced so far
    void serialize(StateArchive& archive) { trials_.serialize(archive); }

private:
    NearPhotons near_;
    ConnectedPairs pairs_;
    BernoulliTrials trials_;
    Kernel weigh_near_pairs_;
};

} // namespace sundog
