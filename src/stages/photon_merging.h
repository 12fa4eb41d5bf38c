// Merging of camera vertices with photons.
#pragma once

#include "stages/camera_subpaths.h"
#include "stages/light_subpaths.h"
#include "stages/photon_map.h"

namespace sundog
{

class PhotonMerging
{
public:
    // density_kernel: as DENSITY_KERNEL.
    PhotonMerging(Device& device, const DeviceScene& scene, PathRules rules, int density_kernel);

    // Sorts the photons of traced light subpaths.
    void build(const LightSubpaths& light, float radius);

    // Merges the vertices of this bounce, and adds what that brings to the radiance of their paths.
    void merge(PathPool& pool, const CameraSubpaths& camera, Techniques techniques, Buffer<Vec3>& radiance);

private:
    Device* device_;
    PathRules rules_;
    float radius_ = 0.0f;
    PhotonMap map_;
    Kernel reorder_merge_weights_, merge_photons_;
    Buffer<float> weight_streams_;
};

} // namespace sundog
