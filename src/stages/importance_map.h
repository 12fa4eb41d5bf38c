// Where photons matter to the camera: importons, and the photons that survive by them [Peter and Pietrek 1998].
#pragma once

#include "shared/bsdf.h"
#include "shared/sampler.h"
#include "stages/photon_gather.h"

namespace sundog
{

class ImportanceMap
{
public:
    // capacity: of queries at once; importons: the most that will be added; radius: of the lookups whose photons matter.
    ImportanceMap(Device& device, const DeviceScene& scene, std::size_t capacity, std::size_t importons, float radius);

    // Leaves an importon at each query, of which there are `capacity`.
    void add(const Buffer<GatherQuery>& queries);
    void build(); // once all are there

    // The photons that survive, in order, their flux divided by the probability of that. key: of no other call.
    std::vector<Photon> thin(const RecordList<Photon>& photons, std::size_t count, SamplerKey key);

private:
    std::size_t capacity_;
    float radius_;
    float scene_radius_;
    float enough_ = 1.0f; // importons within the radius, for a photon to survive for certain
    Kernel leave_importons_;
    Kernel query_photons_;
    Kernel thin_photons_;
    Compaction compaction_;
    Buffer<GatherQuery> queries_;
    Buffer<LobeRecord> no_lobes_;
    Buffer<Photon> deposits_;
    Buffer<uint> flags_, item_count_;
    RecordList<Photon> importons_, survivors_;
    PhotonMap map_;
    PhotonGather<> gather_;
};

} // namespace sundog
