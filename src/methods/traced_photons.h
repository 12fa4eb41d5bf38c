// Photons of whole maps: traced once, before the first iteration, or anew in each, or from a file.
#pragma once

#include "methods/parameters.h"
#include "methods/render_context.h"
#include "stages/importance_map.h"
#include "stages/light_paths.h"

#include <memory>
#include <optional>

namespace sundog
{

struct TracedPhotons {
    std::vector<Photon> photons;   // in the order of their batches, bounces and paths
    std::uint64_t light_paths = 0; // emitted: settings.paths, or a few more
    std::uint64_t rays = 0;
};

// Traces the photons of one map, as often as is wanted. Light paths go in batches of equal size, so that memory does not grow with
// their number. Maps of one render that are to be independent of each other have
// different numbers.
class MapTracer
{
public:
    MapTracer(RenderContext& context, const Parameters& parameters, const PhotonTracerSettings& settings, uint map_number);

    // A pure function of the seed, the map's number and `set`: sets of photons independent of each other. With `importance` only
    // those that survive by it. The pool holds batch_size() paths.
    TracedPhotons trace(PathPool& pool, std::uint64_t set, ImportanceMap* importance = nullptr);
    std::size_t batch_size() const { return settings_.paths; }
    void serialize(StateArchive& archive) { tracer_.serialize(archive); }
    std::uint64_t light_paths() const { return batches_ * settings_.paths; } // of a set

private:
    void refuse_beyond_memory(std::size_t photons_of_first_batch) const;

    RenderContext& context_;
    Parameters parameters_;
    std::size_t batches_;
    PhotonTracerSettings settings_; // of a batch
    uint map_number_;
    PhotonTracer tracer_;
    Buffer<Photon> deposits_;
};

// What the maps of photonmapper hold. Without caustic map: nothing in the scene focuses light.
struct MapPhotons {
    TracedPhotons global;
    std::optional<TracedPhotons> caustic;
};

// The same as the parameters say; importons, where they ask for some, are those of all sets.
class MapPhotonTracer
{
public:
    MapPhotonTracer(RenderContext& context, const Parameters& parameters);
    MapPhotons trace(std::uint64_t set);
    void serialize(StateArchive& archive);

    const MapTracer& global() const { return global_; }
    const std::optional<MapTracer>& caustic() const { return caustic_; }

private:
    RenderContext& context_;
    Parameters parameters_;
    MapTracer global_;
    std::optional<MapTracer> caustic_;
    std::optional<PathPool> pool_;
    std::unique_ptr<ImportanceMap> importance_;
};

// Traced, or read from load_map; and written to save_map. Throws FileError.
MapPhotons make_map_photons(RenderContext& context, const Parameters& parameters);

} // namespace sundog
