// The photon map: photons of one iteration in a grid, found by position.
#pragma once

#include "shared/photon.h"
#include "stages/compaction.h"
#include "stages/device_scene.h"
#include "stages/key_sort.h"

#include <memory>

namespace sundog {

class PhotonMap {
public:
    // bounds: of everything that photons lie on. keeps_order: order() says, after a build, which photon lies where.
    PhotonMap(Device& device, const Bounds& bounds, bool keeps_order = false);

    // Sorts the photons into cells for queries of at most `largest_radius` (scene units). `count` of them,
    // as the host knows it.
    void build(const RecordList<Photon>& photons, std::size_t count, float largest_radius);

    // The same for queries of any radius, `usual_radius` being what most have: the grid is dense, at the price of wider cells
    // in a large scene.
    void build_dense(const RecordList<Photon>& photons, std::size_t count, float usual_radius);

    // Room for `count` photons that is free until the next build(), at the price of what the map holds now.
    Buffer<Photon>& lend_room(std::size_t count);

    // Kernels take them together: bind().
    const PhotonGrid& grid() const { return grid_; }
    const Buffer<uint>& cell_ends() const { return sort_->ends(); }
    uint cell_ends_offset() const { return sort_->ends_offset(); }
    const Buffer<float>& streams() const { return streams_; }
    const Buffer<uint>& order() const { return sort_->order(); }

private:
    void reserve(std::size_t photons);
    void fill(const RecordList<Photon>& photons, std::size_t count);
    void sort_and_lay_out(const RecordList<Photon>& photons, std::size_t count);

    Device* device_;
    Bounds bounds_;
    bool keeps_order_;
    Kernel photon_cell_keys_;
    Kernel scatter_photons_;
    Kernel reorder_photons_, lay_out_sorted_;
    std::unique_ptr<KeySort> sort_;
    Buffer<Photon> sorted_; // only where photons are scattered whole
    Buffer<float> streams_;
    Buffer<Photon> lent_; // the streams' memory
    uint table_size_ = 0;
    PhotonGrid grid_{};
};

// Binds as MAP_PARAMETERS.
void bind(ArgumentBinder& binder, const PhotonMap& map);

// The smallest radius of at least `radius` whose cells fit the table, so that its grid is dense. Pure, for tests.
float dense_grid_radius(const Bounds& bounds, float radius, uint table_size);

// The grid for a radius: dense when its cells fit the table, else rows hashed into it. Pure, for tests.
PhotonGrid make_photon_grid(const Bounds& bounds, float largest_radius, uint table_size, uint stride);

} // namespace sundog
