// Chi-squared progressive photon mapping [Lin, Li, Zeng, Zhang, Jia, Wang, Ramamoorthi and Yan 2020, ACM TOG 39(5)]: a
// pixel keeps its radius while a chi-squared test cannot tell the photons in it from evenly spread ones, and so where
// light is even no radius shrinks and variance falls as 1 / N. Estimates are averaged as they are, each by its own
// radius: what was gathered with a wide radius before a test failed stays, and its share vanishes.
#include "device/buffer_state.h"
#include "math/chi_squared.h"
#include "methods/photon_pass.h"
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

class ChiSquaredProgressivePhotonMapping final : public Method
{
public:
    ChiSquaredProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), shrink_(static_cast<float>(parameters.real("shrink"))), pass_(context, parameters),
          gather_(make_gather<BinnedSum>(context, "estimators/binned_flux.h")),
          set_query_radii_(context.device, "set_query_radii", "Set query radii", BuildOptions{{{"PIXEL_STATISTICS", "TestedPixel"}}, {}}),
          test_photon_bins_(context.device, "test_photon_bins", "Test photon bins"),
          thresholds_(context.device, test_thresholds(parameters.real("significance")), "test thresholds"),
          pixels_(context.device, std::vector<TestedPixel>(pass_.pixels(), first_statistics(parameters)), "tested pixels")
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        const uint count = static_cast<uint>(pass_.pixels());
        pass_.trace(iteration, pass_.first_radius());
        set_query_radii_(count, pixels_, count, pass_.queries.queries);
        pass_.estimate_bias(0); // the uniform kernel
        pass_.gather_photons(gather_);
        const float inverse_paths = 1.0f / static_cast<float>(pass_.light_paths());
        test_photon_bins_(count, pass_.queries.queries, gather_.sums, thresholds_, count, shrink_, inverse_paths, pixels_,
                          pass_.camera.radiance);
        context_.spectral.to_rgb(pass_.camera.radiance);
        context_.film.accumulate(pass_.camera.radiance);
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override
    {
        pass_.serialize(archive);
        sundog::serialize(archive, "tested pixels", pixels_);
    }

private:
    TestedPixel first_statistics(const Parameters& parameters) const
    {
        TestedPixel pixel{};
        pixel.radius_squared = pass_.first_radius() * pass_.first_radius();
        pixel.first_test = pixel.next_test = static_cast<float>(parameters.integer("first_test"));
        return pixel;
    }

    RenderContext& context_;
    float shrink_;
    PhotonPass pass_;
    PhotonGather<BinnedSum> gather_;
    Kernel set_query_radii_;
    Kernel test_photon_bins_;
    Buffer<TestThreshold> thresholds_;
    Buffer<TestedPixel> pixels_;
};

ParameterSpec significance_spec()
{
    return {"significance",
            ParameterType::real,
            "0.05",
            "",
            "Probability with which evenly spread photons are taken for uneven ones, over all tests of the same photons (Lin et al. 2020).",
            1e-9,
            0.5,
            {}};
}

ParameterSpec shrink_spec()
{
    return {"shrink", ParameterType::real, "0.8", "", "Factor on the squared radius where a test fails (Lin et al. 2020, k).", 0.1, 0.99,
            {}};
}

ParameterSpec first_test_spec()
{
    return {"first_test",
            ParameterType::integer,
            "60",
            "photons",
            "Photons before a pixel's first test; 12 bins need about five each.",
            12,
            1e6,
            {}};
}

const MethodRegistration registration({
    .name = "cppm",
    .title = "Chi-squared progressive photon mapping",
    .paper = "Lin, Li, Zeng, Zhang, Jia, Wang, Ramamoorthi and Yan 2020, ACM Transactions on Graphics 39(5)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Every pixel tests whether the photons it finds lie evenly, and shrinks its radius only where they do not. Keeps wide "
                   "radii, and so little "
                   "noise, where light is even.",
    .parameters = {photons_spec(), radius_spec(), significance_spec(), shrink_spec(), first_test_spec(), direct_spec(), light_choice_spec(), max_depth_spec(),
                   rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(), spectral_spec(), iterations_spec()},
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<ChiSquaredProgressivePhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
