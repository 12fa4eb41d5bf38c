// Every pixel's radius shrinks by the photons that it has found [Hachisuka, Ogaki and Jensen 2008, ACM TOG 27(5), section 4],
// and every iteration's estimate counts with the radius it was made with. (sppm rescales the flux found so far instead.)
#include "device/buffer_state.h"
#include "methods/radius_policy.h"
#include "shared/counted_radius.h"

#include <cmath>

namespace sundog
{
namespace
{

class LocalRadii final : public RadiusPolicy
{
public:
    LocalRadii(RenderContext& context, const Parameters& parameters)
        : first_radius_(first_radius(context, parameters)), alpha_(static_cast<float>(parameters.real("alpha"))),
          kernel_(density_kernel(parameters)), gather_(make_gather(context, "estimators/counted_radiance.h", kernel_)),
          set_query_radii_(context.device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "CountedPixel"}}, {}}),
          add_gathered_(context.device, "add_gathered", "Add gathered light"),
          shrink_radii_(context.device, "shrink_radii", "Shrink radii"),
          pixels_(context.device, std::vector<CountedPixel>(context.film.pixel_count(), {first_radius_ * first_radius_, 0, 0}),
                  "counted pixels")
    {
    }

    float widest(std::uint64_t) const override { return first_radius_; }

    void estimate(PhotonPass& pass, std::uint64_t) override
    {
        const uint count = static_cast<uint>(pass.pixels());
        set_query_radii_(count, pixels_, count, pass.queries.queries);
        pass.estimate_bias(kernel_);
        pass.gather_photons(gather_);
        add_gathered_(count, pass.queries.queries, gather_.sums, count, pass.inverse_paths(), pass.camera.radiance);
        pass.begin_update();
        shrink_radii_(count, pass.queries.queries, gather_.sums, count, alpha_, pixels_);
    }

    void serialize(StateArchive& archive) override
    {
        sundog::serialize(archive, "counted pixels", pixels_, [this](const CountedPixel& pixel) {
            return is_shrunk(pixel.radius_squared, first_radius_) && pixel.count >= 0.0f && std::isfinite(pixel.count) &&
                   std::isfinite(pixel.count_error);
        });
    }

private:
    float first_radius_, alpha_;
    int kernel_;
    PhotonGather<> gather_;
    Kernel set_query_radii_;
    Kernel add_gathered_;
    Kernel shrink_radii_;
    Buffer<CountedPixel> pixels_;
};

} // namespace

std::unique_ptr<RadiusPolicy> make_local_radii(RenderContext& context, const Parameters& parameters)
{
    return std::make_unique<LocalRadii>(context, parameters);
}

} // namespace sundog
