// Final gathering: the light that a visible point scatters is looked up where a ray from it arrives.
#pragma once

#include "stages/query_paths.h"

namespace sundog
{

class FinalGather
{
public:
    FinalGather(Device& device, const DeviceScene& scene, std::size_t capacity, PathRules rules, SamplerKind sampler);

    // Sends one ray from each point where `visible` asks for photons, as left by its trace() of the same camera, pool and
    // key; leaves a query of the given radius (scene units) where it arrives, through specular and narrow lobes if need be.
    void trace(const DeviceScene& scene, const CameraPaths& camera, const QueryTracer& visible, PathPool& pool, SamplerKey key,
               float radius);

    Buffer<GatherQuery> queries; // by path; radius 0 where there is none
    Buffer<LobeRecord> lobes;    // by path, where the query evaluates one

private:
    PathRules rules_;
    Kernel set_query_radius_;
    Kernel begin_final_gather_;
    Kernel shade_gather_path_;
};

} // namespace sundog
