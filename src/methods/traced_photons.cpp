#include "methods/traced_photons.h"

#include "base/atomic_file.h"
#include "methods/importons.h"
#include "methods/photon_map_file.h"
#include "methods/standard_parameters.h"

#include <algorithm>

namespace sundog
{

namespace
{

// Paths in flight: some 150 bytes each.
constexpr std::size_t largest_batch = std::size_t(1) << 18;

PhotonMapOrigin origin_of(const RenderContext& context, const Parameters& parameters)
{
    PhotonMapOrigin origin{context.light_fingerprint(), {}};
    for (const char* name : {"final_gather", "direct", "max_depth", "rr_depth"})
        origin.parameters.emplace_back(name, parameters.text(name));
    // As many as the file has, unless the user asks for a number.
    for (const char* name : {"photons", "caustic_photons"})
        origin.parameters.emplace_back(name, parameters.is_set(name) ? parameters.text(name) : "");
    return origin;
}

std::size_t caustic_path_count(const Parameters& parameters, std::size_t pixels)
{
    const std::int64_t photons = parameters.integer("caustic_photons");
    return photons > 0 ? static_cast<std::size_t>(photons) : 4 * light_path_count(parameters, pixels);
}

PhotonTracerSettings global_settings(const RenderContext& context, const Parameters& parameters)
{
    PhotonTracerSettings settings{light_path_count(parameters, context.film.pixel_count()), path_rules(parameters), false,
                                  sampler_kind(parameters), PhotonsKept::scattered};
    // What is gathered is all the light that arrives.
    if (parameters.boolean("final_gather")) settings.kept = PhotonsKept::all;
    return settings;
}

PhotonTracerSettings caustic_settings(const RenderContext& context, const Parameters& parameters)
{
    return {caustic_path_count(parameters, context.film.pixel_count()), path_rules(parameters), parameters.text("direct") == "nee",
            sampler_kind(parameters), PhotonsKept::caustic};
}

std::size_t batch_count(const PhotonTracerSettings& settings)
{
    return (settings.paths + largest_batch - 1) / largest_batch;
}

PhotonTracerSettings of_a_batch(PhotonTracerSettings settings)
{
    settings.paths = (settings.paths + batch_count(settings) - 1) / batch_count(settings);
    return settings;
}

} // namespace

MapTracer::MapTracer(RenderContext& context, const PhotonTracerSettings& settings, uint map_number)
    : context_(context), batches_(batch_count(settings)), settings_(of_a_batch(settings)), map_number_(map_number),
      tracer_(context.device, context.scene, settings_), deposits_(context.device, settings_.paths, "photon deposits")
{
}

TracedPhotons MapTracer::trace(PathPool& pool, std::uint64_t set, ImportanceMap* importance)
{
    TracedPhotons traced;
    const std::uint64_t rays_before = pool.rays_traced();
    for (std::size_t batch = 0; batch < batches_; batch++) {
        // Batches and sets continue the points of one sequence; above 2^32 another begins (kernels/math/sampler.h).
        const SamplerKey key = sampler_key(context_.seed, (static_cast<std::uint64_t>(map_number_) << 32) + set * batches_ + batch);
        const std::size_t stored = tracer_.trace(context_.scene, pool, key, deposits_);
        const std::vector<Photon> photons =
            importance ? importance->thin(tracer_.photons(), stored, key) : tracer_.photons().records().download(0, stored);
        traced.photons.insert(traced.photons.end(), photons.begin(), photons.end());
    }
    traced.light_paths = light_paths();
    traced.rays = pool.rays_traced() - rays_before;
    return traced;
}

MapPhotonTracer::MapPhotonTracer(RenderContext& context, const Parameters& parameters)
    : context_(context), parameters_(parameters), global_(context, global_settings(context, parameters), 0)
{
    const PhotonTracerSettings settings = caustic_settings(context, parameters);
    if (!settings.direct_light_elsewhere || context.scene.has_focused_light()) caustic_.emplace(context, settings, 1);
    pool_.emplace(context.device, context.scene, std::max(global_.batch_size(), caustic_ ? caustic_->batch_size() : 0));
}

MapPhotons MapPhotonTracer::trace(std::uint64_t set)
{
    std::uint64_t importon_rays = 0;
    // Where glass disperses camera paths go elsewhere at other wavelengths.
    if (!importance_ || context_.spectral.is_on()) importance_ = trace_importons(context_, parameters_, importon_rays);
    MapPhotons maps{global_.trace(*pool_, set, importance_.get()), {}};
    // A resumed render has counted them before.
    if (set == 0 || context_.spectral.is_on()) maps.global.rays += importon_rays;
    if (caustic_) maps.caustic = caustic_->trace(*pool_, set, importance_.get());
    return maps;
}

void MapPhotonTracer::serialize(StateArchive& archive)
{
    global_.serialize(archive);
    if (caustic_) caustic_->serialize(archive);
}

MapPhotons make_map_photons(RenderContext& context, const Parameters& parameters)
{
    const std::string &from = parameters.text("load_map"), &to = parameters.text("save_map");
    if (!to.empty()) check_file_replaceable(to); // before the work
    const PhotonMapOrigin origin = from.empty() && to.empty() ? PhotonMapOrigin{} : origin_of(context, parameters);
    const MapPhotons photons = from.empty() ? MapPhotonTracer(context, parameters).trace(0) : load_photon_maps(from, origin, context.scene.bounds());
    if (!to.empty()) save_photon_maps(to, origin, photons);
    return photons;
}

} // namespace sundog
