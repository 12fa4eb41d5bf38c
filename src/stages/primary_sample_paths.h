// Light transport as a function of primary samples: what the numbers that Markov chains propose contribute to the film.
#pragma once

#include "shared/regularization.h"
#include "stages/chain_splats.h"

#include <memory>

namespace sundog
{

struct PrimarySampleSettings {
    std::size_t chains = 0;
    std::size_t pixels = 0; // of the film
    PathRules rules{};
    bool regularized = false;
};

class PrimarySamplePaths
{
public:
    virtual ~PrimarySamplePaths() = default;

    // Makes the paths that the chains propose. Returns what each contributes to the film's mean, as one number
    // (kernels/math/scalar_contribution.h), by chain.
    virtual const Buffer<float>& trace(const DeviceScene& scene, PathPool& pool, MarkovChains& chains) = 0;

    // For the paths to come, where settings say that they are regularized: camera paths alone can be.
    void regularize(Regularization regularization) { regularization_ = regularization; }

    // How many splats they have, and leaves them as those of samples first_sample + chain.
    virtual std::size_t splat_count() const = 0;
    virtual void leave_splats(uint first_sample, ChainSplats& splats) const = 0;

    virtual void serialize(StateArchive&) {}

protected:
    Regularization regularization_{};
};

// Camera paths with next-event estimation, as those of path.
std::unique_ptr<PrimarySamplePaths> make_camera_sample_paths(Device& device, const DeviceScene& scene, const Camera& camera,
                                                             const PixelFilter& filter, const PrimarySampleSettings& settings);

// A camera and a light subpath each, joined in every way, as those of bdpt.
std::unique_ptr<PrimarySamplePaths> make_bidirectional_sample_paths(Device& device, const DeviceScene& scene, const Camera& camera,
                                                                    const PixelFilter& filter, const PrimarySampleSettings& settings);

} // namespace sundog
