// A pixel keeps its radius while a chi-squared test cannot tell the photons in it from evenly spread ones [Lin, Li, Zeng, Zhang,
// Jia, Wang, Ramamoorthi and Yan 2020, ACM TOG 39(5)], and so where light is even no radius shrinks and variance falls as 1 / N.
#include "device/buffer_state.h"
#include "math/chi_squared.h"
#include "methods/radius_policy.h"
#include "shared/binned_photons.h"

namespace sundog
{
namespace
{

// Thresholds of tests 0, 1, ... of the same counts, which fail by chance with the probability `significance` together.
std::vector<TestThreshold> test_thresholds(double significance)
{
    std::vector<TestThreshold> thresholds;
    for (uint k = 0; k < TEST_THRESHOLDS; k++) {
        const double level = significance / ((k + 1.0) * (k + 2.0));
        thresholds.push_back({static_cast<float>(chi_squared_quantile(level, DISK_BINS - 1)),
                              static_cast<float>(chi_squared_quantile(level, RING_BINS - 1))});
    }
    return thresholds;
}

class ChiSquaredRadii final : public RadiusPolicy
{
public:
    ChiSquaredRadii(RenderContext& context, const Parameters& parameters)
        : first_radius_(first_radius(context, parameters)), shrink_(static_cast<float>(parameters.real("shrink"))),
          kernel_(density_kernel(parameters)), gather_(make_gather<BinnedSum>(context, "estimators/binned_radiance.h", kernel_)),
          set_query_radii_(context.device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "TestedPixel"}}, {}}),
          test_photon_bins_(context.device, "test_photon_bins", "Test photon bins"),
          thresholds_(context.device, test_thresholds(parameters.real("significance")), "test thresholds"),
          pixels_(context.device, std::vector<TestedPixel>(context.film.pixel_count(), first_statistics(parameters)), "tested pixels")
    {
    }

    float widest(std::uint64_t) const override { return first_radius_; }

    void estimate(PhotonPass& pass, std::uint64_t) override
    {
        const uint count = static_cast<uint>(pass.pixels());
        set_query_radii_(count, pixels_, count, pass.queries.queries);
        pass.estimate_bias(kernel_);
        pass.gather_photons(gather_);
        pass.begin_update();
        test_photon_bins_(count, pass.queries.queries, gather_.sums, thresholds_, count, shrink_, pass.inverse_paths(), pixels_,
                          pass.camera.radiance);
    }

    void serialize(StateArchive& archive) override
    {
        sundog::serialize(archive, "tested pixels", pixels_, [this](const TestedPixel& pixel) {
            return is_shrunk(pixel.radius_squared, first_radius_) && pixel.first_test >= 0.0f && pixel.next_test >= 0.0f;
        });
    }

private:
    TestedPixel first_statistics(const Parameters& parameters) const
    {
        TestedPixel pixel{};
        pixel.radius_squared = first_radius_ * first_radius_;
        pixel.first_test = pixel.next_test = static_cast<float>(parameters.integer("first_test"));
        return pixel;
    }

    float first_radius_, shrink_;
    int kernel_;
    PhotonGather<BinnedSum> gather_;
    Kernel set_query_radii_;
    Kernel test_photon_bins_;
    Buffer<TestThreshold> thresholds_;
    Buffer<TestedPixel> pixels_;
};

} // namespace

std::unique_ptr<RadiusPolicy> make_chi_squared_radii(RenderContext& context, const Parameters& parameters)
{
    return std::make_unique<ChiSquaredRadii>(context, parameters);
}

ParameterSpec significance_spec()
{
    return {"significance",
            ParameterType::real,
            "0.05",
            "",
            "With chi_squared: probability with which evenly spread photons are taken for uneven ones, over all tests of the same photons "
            "(Lin et al. 2020).",
            1e-9,
            0.5,
            {}};
}

ParameterSpec shrink_spec()
{
    return {"shrink",
            ParameterType::real,
            "0.8",
            "",
            "With chi_squared: factor on the squared radius where a test fails (Lin et al. 2020, k).",
            0.1,
            0.99,
            {}};
}

ParameterSpec first_test_spec()
{
    return {"first_test",
            ParameterType::integer,
            "60",
            "photons",
            "With chi_squared: photons before a pixel's first test; 12 bins need about five each.",
            12,
            1e6,
            {}};
}

} // namespace sundog
