#include "stages/primary_sample_paths.h"
#include "stages/vertex_connections.h"

namespace sundog
{
namespace
{

LightSubpathSettings light_settings(const PrimarySampleSettings& settings)
{
    return {settings.chains, settings.pixels, settings.rules, SamplerKind::chain, true, false};
}

class BidirectionalSamplePaths final : public PrimarySamplePaths
{
public:
    BidirectionalSamplePaths(Device& device, const DeviceScene& scene, const Camera& camera, const PixelFilter& filter,
                             const PrimarySampleSettings& settings)
        : camera_(CameraPaths::anywhere(device, camera, filter, SamplerKind::chain, settings.chains, scene.surface_options())),
          light_subpaths_(device, scene, camera, light_settings(settings)),
          camera_subpaths_(device, scene, camera, settings.chains, settings.rules, SamplerKind::chain, true, false),
          connections_(device, scene, settings.chains, settings.rules, make_own_connections(device, settings.chains, SamplerKind::chain)),
          add_camera_contributions_(device, "add_camera_contributions", "Sum contributions"),
          // All over the film, a light subpath comes with 1 / pixels of a camera subpath for each pixel.
          techniques_{0.0f, 0.0f, 0.0f, 1.0f, static_cast<float>(settings.pixels)}
    {
        light_subpaths_.splats().keep_owners();
    }

    const Buffer<float>& trace(const DeviceScene& scene, PathPool& pool, MarkovChains& chains) override
    {
        const SamplerSource numbers = chains.numbers();
        light_subpaths_.trace(scene, camera_, pool, numbers, techniques_);
        chains.count_used_numbers(ChainStream::light, pool.paths);
        camera_.start(scene, pool, numbers);
        for (;;) {
            camera_subpaths_.shade(scene, camera_, pool, numbers, techniques_, Regularization{});
            connections_.connect(scene, {pool, camera_subpaths_, light_subpaths_, numbers.key}, camera_.radiance);
            if (!pool.keep_alive()) break;
            pool.trace(scene);
        }
        chains.count_used_numbers(ChainStream::camera, pool.paths);
        Buffer<float>& contributions = light_subpaths_.splats().contributions();
        add_camera_contributions_(camera_.count(), camera_.radiance, static_cast<uint>(camera_.count()), contributions);
        return contributions;
    }

    std::size_t splat_count() const override { return camera_.count() + light_subpaths_.splats().stored(); }

    void leave_splats(uint first_sample, ChainSplats& splats) const override
    {
        splats.leave_camera_splats(first_sample, camera_);
        splats.leave_light_splats(first_sample, light_subpaths_.splats());
    }

    void serialize(StateArchive& archive) override { light_subpaths_.serialize(archive); }

private:
    CameraPaths camera_;
    LightSubpaths light_subpaths_;
    CameraSubpaths camera_subpaths_;
    VertexConnections connections_;
    Kernel add_camera_contributions_;
    Techniques techniques_;
};

} // namespace

std::unique_ptr<PrimarySamplePaths> make_bidirectional_sample_paths(Device& device, const DeviceScene& scene, const Camera& camera,
                                                                    const PixelFilter& filter, const PrimarySampleSettings& settings)
{
    return std::make_unique<BidirectionalSamplePaths>(device, scene, camera, filter, settings);
}

} // namespace sundog
