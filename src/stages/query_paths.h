// Camera paths that look for photons.
#pragma once

#include "shared/bsdf.h"
#include "shared/photon.h"
#include "stages/camera_paths.h"

namespace sundog {

class QueryTracer {
public:
    // direct_light: next-event estimation at the queries.
    QueryTracer(Device& device, const DeviceScene& scene, std::size_t capacity, PathRules rules, bool direct_light, SamplerKind sampler);

    // Follows camera paths, started before, through specular surfaces; leaves at most one query a path and adds
    // emission and direct light to the camera's radiance. radius > 0 (scene units) is what the queries ask for.
    void trace(const DeviceScene& scene, CameraPaths& camera, PathPool& pool, SamplerKey key, float radius);

    Buffer<GatherQuery> queries; // by path; radius 0 where there is none
    Buffer<LobeRecord> lobes;    // by path, where the query evaluates one

private:
    PathRules rules_;
    bool direct_light_;
    Kernel shade_query_path_;
    ShadowRays shadow_;
};

} // namespace sundog
