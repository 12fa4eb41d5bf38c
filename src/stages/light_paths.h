// Light paths that leave photons.
#pragma once

#include "shared/photon.h"
#include "stages/path_pool.h"
#include "stages/sampling.h"

namespace sundog {

// Which of a path's photons stay.
enum class PhotonsKept {
    all = PHOTONS_ALL,
    caustic = PHOTONS_CAUSTIC,     // light focused by specular and narrow lobes alone, or straight from its source
    scattered = PHOTONS_SCATTERED, // the others
};

struct PhotonTracerSettings {
    std::size_t paths = 0; // light subpaths an iteration
    PathRules rules{};
    bool direct_light_elsewhere = false; // leave out photons straight from a light
    SamplerKind sampler = SamplerKind::sobol;
    PhotonsKept kept = PhotonsKept::all;
};

class PhotonTracer {
public:
    PhotonTracer(Device& device, const DeviceScene& scene, const PhotonTracerSettings& settings);

    // Traces one iteration's light paths to their ends. Returns the number of photons stored. deposits: room for a photon
    // of each path, free from now until then.
    std::size_t trace(const DeviceScene& scene, PathPool& pool, SamplerKey key, Buffer<Photon>& deposits);

    const RecordList<Photon>& photons() const { return photons_; }

    void serialize(StateArchive& archive) { photons_.serialize(archive); }

private:
    void trace_once(const DeviceScene& scene, PathPool& pool, SamplerKey key, Buffer<Photon>& deposits);

    PhotonTracerSettings settings_;
    Kernel emit_light_paths_;
    Kernel shade_photon_path_;
    RecordList<Photon> photons_;
};

} // namespace sundog
