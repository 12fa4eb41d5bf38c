#include "stages/path_tracer.h"
#include "stages/primary_sample_paths.h"

namespace sundog
{
namespace
{

class CameraSamplePaths final : public PrimarySamplePaths
{
public:
    CameraSamplePaths(Device& device, const DeviceScene& scene, const Camera& camera, const PixelFilter& filter,
                      const PrimarySampleSettings& settings)
        : camera_(CameraPaths::anywhere(device, camera, filter, SamplerKind::chain, settings.chains, scene.surface_options())),
          tracer_(device, scene, settings.chains, settings.rules, SamplerKind::chain, settings.regularized),
          add_camera_contributions_(device, "add_camera_contributions", "Sum contributions"),
          contributions_(device, settings.chains, "contributions")
    {
    }

    const Buffer<float>& trace(const DeviceScene& scene, PathPool& pool, MarkovChains& chains) override
    {
        camera_.start(scene, pool, chains.numbers());
        tracer_.trace(scene, camera_, pool, chains.numbers(), regularization_);
        chains.count_used_numbers(ChainStream::camera, pool.paths);
        contributions_.fill(0.0f);
        add_camera_contributions_(camera_.count(), camera_.radiance, static_cast<uint>(camera_.count()), contributions_);
        return contributions_;
    }

    std::size_t splat_count() const override { return camera_.count(); }
    void leave_splats(uint first_sample, ChainSplats& splats) const override { splats.leave_camera_splats(first_sample, camera_); }

private:
    CameraPaths camera_;
    PathTracer tracer_;
    Kernel add_camera_contributions_;
    Buffer<float> contributions_;
};

} // namespace

std::unique_ptr<PrimarySamplePaths> make_camera_sample_paths(Device& device, const DeviceScene& scene, const Camera& camera,
                                                             const PixelFilter& filter, const PrimarySampleSettings& settings)
{
    return std::make_unique<CameraSamplePaths>(device, scene, camera, filter, settings);
}

} // namespace sundog
