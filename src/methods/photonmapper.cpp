// Photon mapping [Jensen 1996, Global Illumination using Photon Maps]: photons are traced once, and stay. What a camera path
// sees first is lit straight from the lights by next-event estimation, by focused light from the caustic map, and by all
// other light from the global map: looked up where a ray that gathers it arrives [section 4.2], or at once. Iterations
// average camera paths; the maps' blur and noise stay.
//
// With fresh maps each iteration traces photons of its own. Its image is one of the same method by another seed, so that the mean
// of iterations keeps the blur alone; and how they differ tells its error, as in the progressive methods.
//
// In spectral transport one map is traced again in each iteration, by the same random numbers at that iteration's
// wavelengths: the same photons, in other colours, and elsewhere only where glass bends each colour another way.
//
// With progressive relaxation each iteration traces new photons, whose flux those of the first take up.
#include "base/errors.h"
#include "base/hash.h"
#include "methods/importons.h"
#include "methods/light_pass.h"
#include "methods/lookup_bias.h"
#include "methods/method.h"
#include "methods/photon_map_conflicts.h"
#include "methods/photon_map_parameters.h"
#include "methods/traced_photons.h"
#include "stages/final_gather.h"
#include "stages/photon_relaxation.h"
#include "stages/precomputed_irradiance.h"
#include "stages/progressive_relaxation.h"

#include <optional>

namespace sundog
{
namespace
{

// Between the directions of photons that even each other out: focused light comes in wavefronts, which may cross.
constexpr float any_direction = -1.0f;
constexpr float one_wavefront = 0.95f;

class PhotonMapping final : public Method
{
public:
    PhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), parameters_(parameters),
          camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          are_loaded_(!parameters.text("load_map").empty()), pool_(context.device, context.scene, camera_.count()),
          visible_(context.device, context.scene, camera_.count(), query_rules(parameters), parameters.text("direct") == "nee",
                   sampler_kind(parameters))
    {
        refuse_conflicts_of_photon_maps(parameters, context.film.errors.has_value());
        if (parameters.boolean("final_gather"))
            final_gather_.emplace(context.device, context.scene, camera_.count(), query_rules(parameters), sampler_kind(parameters));
        if (context.spectral.is_on() || has_fresh_maps(parameters) || parameters.boolean("relaxation_progressive"))
            tracer_.emplace(context, parameters);
        else
            make_maps(make_map_photons(context, parameters));
        if (parameters.boolean("relaxation_progressive")) begin_progressive_relaxation();
    }

    void render_pass(std::uint64_t iteration) override
    {
        // One map at other wavelengths: the same photons; else others.
        const bool are_same = context_.spectral.is_on() && !has_fresh_maps(parameters_);
        if (relaxed_global_) context_.film.begin_update(); // photons move
        if (tracer_) make_maps(tracer_->trace(are_same ? 0 : iteration));
        const SamplerKey key = sampler_key(context_.seed, iteration);
        const float radius = global_->lookup().radius;
        camera_.start(context_.scene, pool_, key);
        if (context_.film.begin_first_hits(iteration)) camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        visible_.trace(context_.scene, camera_, pool_, key, radius);
        if (final_gather_) {
            final_gather_->trace(context_.scene, camera_, visible_, pool_, key, radius);
            if (irradiance_) irradiance_->answer(final_gather_->queries, camera_.radiance);
            look_up(*global_, global_bias_, final_gather_->queries, final_gather_->lobes, iteration);
        } else {
            look_up(*global_, global_bias_, visible_.queries, visible_.lobes, iteration);
        }
        if (caustic_) look_up(*caustic_, caustic_bias_, visible_.queries, visible_.lobes, iteration);
        context_.spectral.to_rgb(camera_.radiance);
        if (context_.film.errors) context_.spectral.to_rgb(context_.film.errors->bias);
        context_.film.accumulate(camera_.radiance);
    }

    MethodCounters counters() const override
    {
        return {light_paths_, context_.film.iterations() * camera_.count(), photons_stored_, rays_ + pool_.rays_traced()};
    }

    // The maps follow from the seed, or from their file.
    void serialize(StateArchive& archive) override
    {
        std::uint64_t maps = digest_.low();
        archive.value("photon maps", maps);
        if (maps != digest_.low())
            throw FileError("cannot resume, the photon maps are not those that the render began with; load those (-p load_map=FILE)");
        if (tracer_) tracer_->serialize(archive);
        for (auto* relaxed : {&relaxed_global_, &relaxed_caustic_})
            if (*relaxed) (*relaxed)->serialize(archive, context_.scene.bounds());
        archive.count("map light paths", light_paths_);
        archive.count("map photons", photons_stored_);
        archive.count("map rays", rays_);
        pool_.serialize(archive);
    }

private:
    void begin_progressive_relaxation()
    {
        const float radius = global_lookup(context_, parameters_, tracer_->global().light_paths()).radius;
        relaxed_global_.emplace(context_.device, radius, any_direction);
        if (!tracer_->caustic()) return;
        const float focused = caustic_lookup(context_, parameters_, tracer_->caustic()->light_paths()).radius;
        relaxed_caustic_.emplace(context_.device, focused, one_wavefront);
    }

    // Adds the light that the queries find, and its bias where errors are asked for.
    void look_up(FixedPhotonMap& map, std::optional<LookupBias>& bias, Buffer<GatherQuery>& queries, const Buffer<LobeRecord>& lobes,
                 std::uint64_t iteration)
    {
        map.add_radiance(queries, lobes, camera_.radiance);
        if (!context_.film.errors) return;
        if (!bias) bias.emplace(context_, map.lookup());
        bias->add(map, queries, lobes, iteration);
    }

    // Moves photons to where the map is to have them; with progressive relaxation they become those of all iterations.
    void relax(std::vector<Photon>& photons, float radius, float least_cosine, std::optional<ProgressiveRelaxation>& progressive)
    {
        const int sweeps = static_cast<int>(parameters_.integer("relaxation"));
        const bool are_first = !progressive || progressive->passes() == 0;
        if (sweeps > 0 && are_first) PhotonRelaxation(context_.device, radius, least_cosine).relax(photons, sweeps);
        if (!progressive) return;
        progressive->add_pass(photons);
        photons = progressive->photons();
    }

    void make_maps(MapPhotons photons)
    {
        const PhotonLookup lookup = global_lookup(context_, parameters_, photons.global.light_paths);
        relax(photons.global.photons, lookup.radius, any_direction, relaxed_global_);
        add_map(global_, photons.global, lookup);
        if (photons.caustic) {
            const PhotonLookup focused = caustic_lookup(context_, parameters_, photons.caustic->light_paths);
            relax(photons.caustic->photons, focused.radius, one_wavefront, relaxed_caustic_);
            add_map(caustic_, *photons.caustic, focused);
        }
        if (parameters_.boolean("precompute")) irradiance_.emplace(context_.device, context_.scene, photons.global.photons, *global_);
    }

    void add_map(std::optional<FixedPhotonMap>& map, const TracedPhotons& traced, const PhotonLookup& lookup)
    {
        // A map of the pass before goes when this one is there: both have the same programs.
        map = FixedPhotonMap(context_.device, context_.scene, camera_.count(), lookup, traced.photons, traced.light_paths,
                             context_.film.errors && lookup.nearest == 0);
        light_paths_ += traced.light_paths;
        photons_stored_ += traced.photons.size();
        rays_ += traced.rays;
        if (are_loaded_)
            digest_.append_field({reinterpret_cast<const char*>(traced.photons.data()), traced.photons.size() * sizeof(Photon)});
    }

    RenderContext& context_;
    Parameters parameters_;
    CameraPaths camera_;
    bool are_loaded_; // the maps
    PathPool pool_;
    QueryTracer visible_;
    std::optional<FinalGather> final_gather_;
    std::optional<MapPhotonTracer> tracer_; // of each iteration's photons, where it has others than the one before
    std::optional<FixedPhotonMap> global_, caustic_;
    std::optional<LookupBias> global_bias_, caustic_bias_; // where errors are asked for
    std::optional<ProgressiveRelaxation> relaxed_global_, relaxed_caustic_;
    std::optional<PrecomputedIrradiance> irradiance_;
    std::uint64_t light_paths_ = 0, photons_stored_ = 0, rays_ = 0; // of the maps; of those of all iterations
    Hash digest_;                                                   // of loaded photons: the file may change
};

const MethodRegistration registration({
    .name = "photonmapper",
    .title = "Photon mapping",
    .paper = "Jensen 1996, Eurographics Workshop on Rendering",
    .estimator_class = "biased",
    .error_model = ErrorModel::bias_and_variance,
    .errors_need = {{"maps", "fresh"}},
    .description =
        "Traces a global and a caustic photon map once, and looks light up in them, diffuse light by final gathering. Soft light without "
        "noise after few iterations; the maps' blur stays however long it renders, and their noise as well unless each iteration traces "
        "others.",
    .parameters = {maps_spec(),
                   global_photons_spec(),
                   global_radius_spec(),
                   caustic_photons_spec(),
                   caustic_radius_spec(),
                   lookup_spec(),
                   nearest_spec(),
                   filter_kernel_spec(),
                   relaxation_spec(),
                   progressive_relaxation_spec(),
                   final_gather_spec(),
                   precompute_spec(),
                   importons_spec(),
                   save_map_spec(),
                   load_map_spec(),
                   direct_spec(),
                   light_choice_spec(),
                   max_depth_spec(),
                   rr_depth_spec(1, "light subpaths, by albedo"),
                   sampler_spec(),
                   spectral_spec(),
                   iterations_spec()},
    .follows_motion = false,
    .create = [](RenderContext& context, const Parameters& parameters) -> std::unique_ptr<Method> {
        return std::make_unique<PhotonMapping>(context, parameters);
    },
});

} // namespace
} // namespace sundog
