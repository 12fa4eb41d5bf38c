#include "methods/traced_photons.h"

#include "base/atomic_file.h"
#include "methods/importons.h"
#include "methods/photon_map_file.h"
#include "methods/standard_parameters.h"

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

MapPhotons trace_map_photons(RenderContext& context, const Parameters& parameters)
{
    const std::size_t pixels = context.film.pixel_count();
    const bool next_event = parameters.text("direct") == "nee";
    PhotonTracerSettings settings{light_path_count(parameters, pixels), path_rules(parameters), false, sampler_kind(parameters),
                                  PhotonsKept::scattered};
    // What is gathered is all the light that arrives.
    if (parameters.boolean("final_gather")) settings.kept = PhotonsKept::all;
    std::uint64_t importon_rays = 0;
    const std::unique_ptr<ImportanceMap> importance = trace_importons(context, parameters, importon_rays);
    MapPhotons maps{trace_photons(context, settings, 0, importance.get()), {}};
    maps.global.rays += importon_rays;
    if (next_event && !context.scene.has_focused_light()) return maps;
    settings.kept = PhotonsKept::caustic;
    settings.direct_light_elsewhere = next_event;
    settings.paths = caustic_path_count(parameters, pixels);
    maps.caustic = trace_photons(context, settings, 1, importance.get());
    return maps;
}

} // namespace

TracedPhotons trace_photons(RenderContext& context, PhotonTracerSettings settings, uint map_number, ImportanceMap* importance)
{
    TracedPhotons traced;
    const std::size_t batches = (settings.paths + largest_batch - 1) / largest_batch;
    settings.paths = (settings.paths + batches - 1) / batches;
    PathPool pool(context.device, context.scene, settings.paths);
    PhotonTracer tracer(context.device, context.scene, settings);
    Buffer<Photon> deposits(context.device, settings.paths, "photon deposits");
    for (std::size_t batch = 0; batch < batches; batch++) {
        // Batches continue the points of one sequence; above 2^32 another begins (kernels/math/sampler.h).
        const SamplerKey key = sampler_key(context.seed, (static_cast<std::uint64_t>(map_number) << 32) + batch);
        const std::size_t stored = tracer.trace(context.scene, pool, key, deposits);
        const std::vector<Photon> photons =
            importance ? importance->thin(tracer.photons(), stored, key) : tracer.photons().records().download(0, stored);
        traced.photons.insert(traced.photons.end(), photons.begin(), photons.end());
    }
    traced.light_paths = batches * settings.paths;
    traced.rays = pool.rays_traced();
    return traced;
}

MapPhotons make_map_photons(RenderContext& context, const Parameters& parameters)
{
    const std::string &from = parameters.text("load_map"), &to = parameters.text("save_map");
    if (!to.empty()) check_file_writable(to); // before the work
    const PhotonMapOrigin origin = from.empty() && to.empty() ? PhotonMapOrigin{} : origin_of(context, parameters);
    const MapPhotons photons = from.empty() ? trace_map_photons(context, parameters) : load_photon_maps(from, origin);
    if (!to.empty()) save_photon_maps(to, origin, photons);
    return photons;
}

} // namespace sundog
