// Light subpaths that camera subpaths are joined to: their vertices, the photons that they leave, and what the lens sees of them.
#pragma once

#include "shared/bidirectional.h"
#include "shared/photon.h"
#include "stages/camera_paths.h"
#include "stages/lens_splats.h"

#include <optional>

namespace sundog
{

struct LightSubpathSettings {
    std::size_t paths = 0; // an iteration
    std::size_t pixels = 0;
    PathRules rules{};
    SamplerKind sampler = SamplerKind::sobol;
    bool connects = true; // keep vertices to connect to, and splats
    bool merges = true;   // keep photons
};

class LightSubpaths
{
public:
    LightSubpaths(Device& device, const DeviceScene& scene, const Camera& camera, const LightSubpathSettings& settings);

    // Traces one iteration's light subpaths.
    void trace(const DeviceScene& scene, const CameraPaths& camera, PathPool& pool, const SamplerSource& numbers, Techniques techniques);

    // Adds what the lens sees of them.
    void add_splats(Buffer<Vec3>& radiance) { splats_.add_to(radiance); }

    LensSplats& splats() { return splats_; }
    const LensSplats& splats() const { return splats_; }

    // Vertices lie in slots, bounce by bounce in path order, some of which are empty (links with rank 0).
    const Buffer<PathVertex>& vertices() const { return vertices_; }
    const Buffer<VertexLink>& links() const { return links_; }
    const Buffer<uint>& last_vertices() const { return last_vertices_; } // by path, or NO_VERTEX
    std::size_t slots() const { return slots_; }

    const RecordList<Photon>& photons() const { return photons_; }
    const RecordList<PhotonVertex>& photon_vertices() const { return photon_vertices_; }
    std::size_t photons_stored() const { return photons_stored_; } // in this iteration

    std::size_t paths() const { return settings_.paths; }
    void serialize(StateArchive& archive);

private:
    bool trace_once(const DeviceScene& scene, const CameraPaths& camera, PathPool& pool, const SamplerSource& numbers, Techniques techniques);
    void reserve_slots(std::size_t slots);
    bool has_room_for(std::size_t slots);
    bool photons_complete();

    Device* device_;
    LightSubpathSettings settings_;
    Kernel emit_light_subpaths_, shade_light_subpath_;
    LensSplats splats_;
    Buffer<Subpath> subpaths_;
    Buffer<PathVertex> vertices_;
    Buffer<VertexLink> links_;
    Buffer<uint> last_vertices_;
    std::size_t slots_ = 0, photons_stored_ = 0;
    Buffer<Photon> photon_deposits_;
    Buffer<PhotonVertex> photon_vertex_deposits_;
    RecordList<Photon> photons_;
    RecordList<PhotonVertex> photon_vertices_;
};

} // namespace sundog
