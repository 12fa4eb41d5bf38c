#include "stages/spectral_transport.h"

#include "scene/wavelength_sampling.h"

namespace sundog {

SpectralTransport::SpectralTransport(Device& device, DeviceScene& scene, std::uint64_t seed) : scene_(scene), seed_(seed)
{
    if (!scene.is_spectral()) return;
    kernels_.emplace(Kernels{Kernel(device, "radiance_to_rgb", "Turn wavelengths into colours"),
                             Kernel(device, "gathered_to_rgb", "Turn gathered wavelengths into colours")});
}

void SpectralTransport::begin_pass(std::uint64_t pass)
{
    if (!kernels_) return;
    Wavelengths wavelengths = make_wavelengths(pass_wavelengths(seed_, pass));
    wavelengths.camera_turn = static_cast<uint>(pass % 3);
    wavelengths.light_turn = static_cast<uint>(pass / 3 % 3);
    scene_.set_wavelengths(wavelengths);
}

void SpectralTransport::to_rgb(Buffer<Vec3>& radiance) const
{
    if (kernels_) kernels_->radiance_to_rgb(radiance.size(), scene_.geometry().globals, static_cast<uint>(radiance.size()), radiance);
}

void SpectralTransport::to_rgb(Buffer<GatherQuery>& queries, Buffer<GatherSum>& sums) const
{
    if (kernels_) kernels_->gathered_to_rgb(queries.size(), scene_.geometry().globals, static_cast<uint>(queries.size()), queries, sums);
}

} // namespace sundog
