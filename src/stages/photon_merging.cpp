#include "stages/photon_merging.h"

namespace sundog
{

PhotonMerging::PhotonMerging(Device& device, const DeviceScene& scene, PathRules rules, int density_kernel)
    : device_(&device), rules_(rules), map_(device, scene.bounds(), true),
      reorder_merge_weights_(device, "reorder_merge_weights", "Lay out merge weights")
{
    BuildOptions options = scene.surface_options();
    options.defines.emplace_back("DENSITY_KERNEL", std::to_string(density_kernel));
    merge_photons_ = Kernel(device, "merge_photons", "Merge photons", options);
}

void PhotonMerging::build(const LightSubpaths& light, float radius)
{
    radius_ = radius;
    map_.build(light.photons(), light.photons_stored(), radius);
    const std::size_t stride = map_.grid().stride;
    if (weight_streams_.size() < 2 * stride) {
        weight_streams_ = {}; // give back before asking for more
        weight_streams_ = Buffer<float>(*device_, 2 * stride, "merge weight streams");
    }
    reorder_merge_weights_(light.photons_stored(), light.photon_vertices().records(), map_.order(), light.photons().count(),
                           static_cast<uint>(stride), weight_streams_);
}

void PhotonMerging::merge(PathPool& pool, const CameraSubpaths& camera, Techniques techniques, Buffer<Vec3>& radiance)
{
    merge_photons_(pool.items(), map_, weight_streams_, rules_,
                   techniques, radius_, pool.active(), pool.active_count(), pool.flags, camera.vertices, radiance);
}

} // namespace sundog
