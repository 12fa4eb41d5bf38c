// Progressive photon mapping [Hachisuka, Ogaki and Jensen 2008, ACM TOG 27(5)]: hit points are found once, and every
// iteration brings new photons to them. Each hit point shrinks its own radius by the photons it finds. What a pixel
// sees is what its hit points saw: edges, depth of field and soft reflections are as fine as there are hit points.
//
// In spectral transport hit points are found again in each iteration, by the same random numbers at that iteration's
// wavelengths: with other throughputs, and, where glass bends each colour another way, spread over what the pixel sees by
// all of them. Statistics go on, in linear sRGB.
#include "methods/light_pass.h"
#include "methods/method.h"
#include "methods/photon_pass.h"
#include "methods/progressive_statistics.h"
#include "methods/radius_policy.h"

#include <algorithm>
#include <deque>

namespace sundog
{
namespace
{

// One hit point a pixel: the query, the emission seen on the way, and what photons have brought.
struct HitPoints {
    CameraPaths camera;
    QueryTracer queries;
    ProgressiveStatistics statistics;
};

// What fixed hit points have found is rescaled to smaller disks as if it lay evenly in them.
void refuse_other_parts(const Parameters& parameters)
{
    if (parameters.text("radius_policy") != "local")
        parameters.refuse(
            "radius_policy",
            "ppm shrinks its hit points' radii by the photons that they find, radius_policy=local; for another choose sppm or "
            "pppm (-m pppm)");
    if (parameters.text("kernel") != "uniform")
        parameters.refuse("kernel",
                          "ppm rescales the flux that it has found, which takes kernel=uniform; for another choose pppm (-m pppm)");
}

class ProgressivePhotonMapping final : public Method
{
public:
    ProgressivePhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), first_radius_(first_radius(context, parameters)), light_(context, parameters, false),
          pool_(context.device, context.scene, std::max(light_.light_paths(), context.film.pixel_count())),
          gather_(make_gather(context, "estimators/flux_sum.h")), clear_radiance_(context.device, "clear_radiance", "Clear radiance"),
          radiance_(context.device, context.film.pixel_count(), "radiance")
    {
        if (context.film.errors) bias_.emplace(context, first_radius_);
        const std::size_t pixels = context.film.pixel_count();
        const auto count = static_cast<std::uint64_t>(parameters.integer("hit_points"));
        for (std::uint64_t i = 0; i < count; i++) {
            HitPoints& points = hit_points_.emplace_back(HitPoints{
                CameraPaths(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
                QueryTracer(context.device, context.scene, pixels, query_rules(parameters), false, sampler_kind(parameters)),
                ProgressiveStatistics(context.device, pixels, first_radius_, parameters.real("alpha"),
                                      context.spectral.is_on() ? DirectLight::varying : DirectLight::constant)});
            points.camera.start(context.scene, pool_, key_of(i));
            points.camera.record_first_hits(context.scene, pool_, i, context.film.first_hits);
            if (!context.spectral.is_on()) points.queries.trace(context.scene, points.camera, pool_, key_of(i), first_radius_);
        }
    }

    void render_pass(std::uint64_t iteration) override
    {
        light_.trace(pool_, sampler_key(context_.seed, iteration), bias_ ? bias_->map_radius(iteration, first_radius_) : first_radius_);
        if (context_.spectral.is_on()) find_hit_points_again();
        if (bias_) estimate_bias(iteration);
        const float inverse_paths = 1.0f / static_cast<float>(light_.light_paths()), share = 1.0f / static_cast<float>(hit_points_.size());
        context_.film.begin_update();
        clear_radiance_(radiance_.size(), static_cast<uint>(radiance_.size()), radiance_);
        for (HitPoints& points : hit_points_) {
            points.statistics.set_radii(points.queries.queries);
            gather_.gather(light_.map, points.queries.queries, points.queries.lobes, radiance_.size());
            context_.spectral.to_rgb(points.queries.queries, gather_.sums);
            points.statistics.update(points.queries.queries, gather_.sums, points.camera.radiance, inverse_paths, share, radiance_);
        }
        context_.film.accumulate(radiance_); // for the variance
        iterations_++;
    }

    void resolve(Image& image) const override
    {
        clear_radiance(image);
        for (const HitPoints& points : hit_points_)
            points.statistics.add_radiance(image, context_.film, points.camera.radiance, light_.light_paths(),
                                           1.0 / static_cast<double>(hit_points_.size()));
    }

    MethodCounters counters() const override
    {
        const std::uint64_t points = hit_points_.size() * context_.film.pixel_count();
        return {iterations_ * light_.light_paths(), context_.spectral.is_on() ? iterations_ * points : points, light_.photons_stored(),
                pool_.rays_traced()};
    }

    // Hit points follow from the seed.
    void serialize(StateArchive& archive) override
    {
        archive.count("photon iterations", iterations_);
        archive.check(iterations_ == context_.film.iterations(), "photon iterations");
        light_.serialize(archive);
        pool_.serialize(archive);
        for (HitPoints& points : hit_points_) points.statistics.serialize(archive);
    }

private:
    SamplerKey key_of(std::uint64_t hit_point) const { return sampler_key(context_.seed, hit_point); }

    void find_hit_points_again()
    {
        for (std::size_t i = 0; i < hit_points_.size(); i++) {
            HitPoints& points = hit_points_[i];
            points.camera.start(context_.scene, pool_, key_of(i));
            points.queries.trace(context_.scene, points.camera, pool_, key_of(i), first_radius_);
            context_.spectral.to_rgb(points.camera.radiance);
        }
    }

    // While the map is sorted for it.
    void estimate_bias(std::uint64_t iteration)
    {
        const float inverse_paths = 1.0f / static_cast<float>(light_.light_paths() * hit_points_.size());
        for (HitPoints& points : hit_points_) {
            points.statistics.set_radii(points.queries.queries);
            bias_->add(light_.map, points.queries.queries, points.queries.lobes, iteration, {0, inverse_paths}); // 0: the uniform kernel
        }
        context_.spectral.to_rgb(context_.film.errors->bias);
        light_.sort_again(first_radius_);
    }

    RenderContext& context_;
    float first_radius_;
    std::uint64_t iterations_ = 0;
    LightPass light_;
    PathPool pool_;
    PhotonGather<> gather_;
    Kernel clear_radiance_;
    Buffer<Vec3> radiance_;            // of this iteration
    std::optional<BiasEstimate> bias_; // where errors are asked for
    std::deque<HitPoints> hit_points_;
};

const MethodRegistration registration({
    .name = "ppm",
    .title = "Progressive photon mapping",
    .paper = "Hachisuka, Ogaki and Jensen 2008, ACM Transactions on Graphics 27(5)",
    .estimator_class = "consistent",
    .error_model = ErrorModel::bias_and_variance,
    .description = "Finds the points that the camera sees once, and lets each shrink its own radius as photons arrive; all light comes by "
                   "photons. Consistent at "
                   "its hit points: for antialiasing and depth of field choose many, or sppm.",
    .parameters = {photons_spec(), radius_spec(), radius_policy_spec("local"), alpha_spec(), kernel_spec("uniform"),
                   ParameterSpec{"hit_points",
                                 ParameterType::integer,
                                 "4",
                                 "a pixel",
                                 "Points that each pixel sees, found before the first iteration.",
                                 1,
                                 256,
                                 {}},
                   max_depth_spec(), rr_depth_spec(1, "light subpaths, by albedo"), sampler_spec(), spectral_spec(), iterations_spec()},
    .follows_motion = false,
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        refuse_other_parts(parameters);
        return std::make_unique<ProgressivePhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
