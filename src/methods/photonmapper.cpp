// Photon mapping [Jensen 1996, Global Illumination using Photon Maps]: photons are traced once, and stay. What a camera path
// sees first is lit straight from the lights by next-event estimation, by focused light from the caustic map, and by all
// other light from the global map: looked up where a ray that gathers it arrives [section 4.2], or at once. Iterations
// average camera paths; the maps' blur and noise stay.
#include "methods/light_pass.h"
#include "methods/method.h"
#include "methods/traced_photons.h"
#include "stages/final_gather.h"
#include "stages/fixed_photon_map.h"
#include "stages/photon_relaxation.h"

#include <cmath>
#include <optional>

namespace sundog
{
namespace
{

// Photons that a lookup of automatic radius should find, and pixels that a caustic's radius may span.
constexpr double usual_photons = 50.0;
constexpr double caustic_pixels = 4.0;
// Radii to search for k photons, as multiples of the one that would hold them if light were even.
constexpr double search_limit = 2.0;

bool next_event(const Parameters& parameters)
{
    return parameters.text("direct") == "nee";
}

std::size_t caustic_path_count(const Parameters& parameters, std::size_t pixels)
{
    const std::int64_t photons = parameters.integer("caustic_photons");
    return photons > 0 ? static_cast<std::size_t>(photons) : 4 * light_path_count(parameters, pixels);
}

// N photons on a sphere of the scene's radius R: N r^2 / (4 R^2) of them lie within r. largest: of automatic radii.
PhotonLookup make_lookup(const Parameters& parameters, const std::string& radius, float scene_radius, std::size_t light_paths,
                         double largest)
{
    PhotonLookup lookup;
    if (parameters.text("lookup") == "nearest") lookup.nearest = static_cast<uint>(parameters.integer("nearest"));
    const double photons = lookup.nearest > 0 ? lookup.nearest : usual_photons;
    const double by_density = 2.0 * static_cast<double>(scene_radius) * std::sqrt(photons / static_cast<double>(light_paths));
    const double automatic = lookup.nearest > 0 ? search_limit * by_density : std::min(by_density, largest);
    lookup.radius = static_cast<float>(parameters.real(radius) > 0.0 ? parameters.real(radius) : automatic);
    lookup.usual_radius = std::min(lookup.radius, static_cast<float>(by_density));
    lookup.density_kernel = density_kernel(parameters);
    return lookup;
}

// Focused light comes in wavefronts, which may cross; other light from everywhere. Photons lie far denser in places than even
// light would, so that the search for neighbours begins small.
Relaxation make_relaxation(const PhotonLookup& lookup, PhotonsKept kept)
{
    return {0.25f * lookup.usual_radius, lookup.radius, kept == PhotonsKept::caustic ? 0.95f : -1.0f};
}

class PhotonMapping final : public Method
{
public:
    PhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), relaxation_sweeps_(static_cast<int>(parameters.integer("relaxation"))),
          camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          pool_(context.device, context.scene, camera_.count()),
          visible_(context.device, context.scene, camera_.count(), query_rules(parameters), next_event(parameters),
                   sampler_kind(parameters))
    {
        const PhotonTracerSettings settings{light_path_count(parameters, camera_.count()), path_rules(parameters), false,
                                            sampler_kind(parameters)};
        const bool gathers = parameters.boolean("final_gather");
        if (gathers)
            final_gather_.emplace(context.device, context.scene, camera_.count(), query_rules(parameters), sampler_kind(parameters));
        PhotonTracerSettings global = settings;
        global.kept = gathers ? PhotonsKept::all : PhotonsKept::scattered;
        add_map(global_, global, make_lookup(parameters, "radius", context.scene.radius(), global.paths, INFINITY), 0);

        if (next_event(parameters) && !context.scene.has_focusing_lobes()) return; // nothing can focus light
        PhotonTracerSettings caustic = settings;
        caustic.kept = PhotonsKept::caustic;
        caustic.direct_light_elsewhere = next_event(parameters);
        caustic.paths = caustic_path_count(parameters, camera_.count());
        const double largest = caustic_pixels * static_cast<double>(pixel_footprint(context.camera, context.scene.bounds()));
        add_map(caustic_, caustic, make_lookup(parameters, "caustic_radius", context.scene.radius(), caustic.paths, largest), 1);
    }

    void render_pass(std::uint64_t iteration) override
    {
        const SamplerKey key = sampler_key(context_.seed, iteration);
        camera_.start(context_.scene, pool_, key);
        camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        visible_.trace(context_.scene, camera_, pool_, key, global_->lookup().radius);
        if (final_gather_) {
            final_gather_->trace(context_.scene, camera_, visible_, pool_, key, global_->lookup().radius);
            global_->add_radiance(final_gather_->queries, final_gather_->lobes, camera_.radiance);
        } else {
            global_->add_radiance(visible_.queries, visible_.lobes, camera_.radiance);
        }
        if (caustic_) caustic_->add_radiance(visible_.queries, visible_.lobes, camera_.radiance);
        context_.film.accumulate(camera_.radiance);
    }

    MethodCounters counters() const override
    {
        return {light_paths_, context_.film.iterations() * camera_.count(), photons_stored_, rays_ + pool_.rays_traced()};
    }

    // The maps follow from the seed.
    void serialize(StateArchive& archive) override { pool_.serialize(archive); }

private:
    void add_map(std::optional<FixedPhotonMap>& map, const PhotonTracerSettings& settings, const PhotonLookup& lookup, uint number)
    {
        TracedPhotons traced = trace_photons(context_, settings, number);
        if (relaxation_sweeps_ > 0)
            PhotonRelaxation(context_.device, context_.scene.bounds(), make_relaxation(lookup, settings.kept))
                .relax(traced.photons, relaxation_sweeps_);
        map.emplace(context_.device, context_.scene, camera_.count(), lookup, traced.photons, traced.light_paths);
        light_paths_ += traced.light_paths;
        photons_stored_ += traced.photons.size();
        rays_ += traced.rays;
    }

    RenderContext& context_;
    int relaxation_sweeps_;
    CameraPaths camera_;
    PathPool pool_;
    QueryTracer visible_;
    std::optional<FinalGather> final_gather_;
    std::optional<FixedPhotonMap> global_, caustic_;
    std::uint64_t light_paths_ = 0, photons_stored_ = 0, rays_ = 0; // of the maps
};

std::vector<ParameterSpec> specs()
{
    ParameterSpec photons = photons_spec();
    photons.description = "Light subpaths of the global map; 0: one a pixel.";
    ParameterSpec radius = radius_spec();
    radius.description =
        "Radius of lookups in the global map, the largest for nearest photons; 0: such that about 50 photons (or those asked for) "
        "are found where light is even, twice that for nearest photons.";
    ParameterSpec caustic_photons = photons;
    caustic_photons.name = "caustic_photons";
    caustic_photons.description = "Light subpaths of the caustic map; 0: four times those of the global map.";
    ParameterSpec caustic_radius = radius;
    caustic_radius.name = "caustic_radius";
    caustic_radius.description = "The same for the caustic map; 0: as `radius`, but a few pixels at most.";
    return {photons,
            radius,
            caustic_photons,
            caustic_radius,
            ParameterSpec{"lookup",
                          ParameterType::choice,
                          "radius",
                          "",
                          "Photons of a lookup: all within the radius, or the nearest (Jensen 1996).",
                          0,
                          0,
                          {"radius", "nearest"}},
            ParameterSpec{"nearest",
                          ParameterType::integer,
                          "50",
                          "photons",
                          "With lookup=nearest: the radius is the distance to the k-th photon, and the k - 1 nearer ones count.",
                          2,
                          512,
                          {}},
            ParameterSpec{"relaxation",
                          ParameterType::integer,
                          "0",
                          "sweeps",
                          "Move photons apart until they lie evenly, so that few suffice for a lookup; about 10 (Spencer and Jones 2009).",
                          0,
                          1000,
                          {}},
            filter_kernel_spec(),
            ParameterSpec{
                "final_gather",
                ParameterType::boolean,
                "true",
                "",
                "Look light that diffuse surfaces have scattered up where one ray an iteration gathers it, or else at once (Jensen 1996).",
                0,
                0,
                {}},
            direct_spec(),
            light_choice_spec(),
            max_depth_spec(),
            rr_depth_spec(1, "light subpaths, by albedo"),
            sampler_spec(),
            iterations_spec()};
}

const MethodRegistration registration({
    .name = "photonmapper",
    .title = "Photon mapping",
    .paper = "Jensen 1996, Eurographics Workshop on Rendering",
    .estimator_class = "biased",
    .description =
        "Traces a global and a caustic photon map once, and looks light up in them, diffuse light by final gathering. Soft light without "
        "noise after few iterations; the maps' blur stays however long it renders.",
    .parameters = specs(),
    .follows_motion = false,
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<PhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
