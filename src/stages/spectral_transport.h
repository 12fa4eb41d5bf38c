// Light computed at three wavelengths a pass instead of as red, green and blue (docs/spectral.md).
#pragma once

#include "shared/photon.h"
#include "stages/device_scene.h"

#include <optional>

namespace sundog {

// Does nothing where the scene is not spectral, so that methods need not ask.
class SpectralTransport {
public:
    SpectralTransport(Device& device, DeviceScene& scene, std::uint64_t seed);

    bool is_on() const { return kernels_.has_value(); }

    // Before a pass: gives the scene its wavelengths, a pure function of seed and pass.
    void begin_pass(std::uint64_t pass);

    // radiance, at the pass's wavelengths, becomes linear sRGB.
    void to_rgb(Buffer<Vec3>& radiance) const;

    // sums become throughput times sum in linear sRGB, and the queries' throughput 1.
    void to_rgb(Buffer<GatherQuery>& queries, Buffer<GatherSum>& sums) const;

private:
    struct Kernels {
        Kernel radiance_to_rgb, gathered_to_rgb;
    };

    DeviceScene& scene_;
    std::uint64_t seed_;
    std::optional<Kernels> kernels_;
};

} // namespace sundog
