#include "stages/photon_map.h"

#include <algorithm>
#include <bit>

namespace sundog {

namespace {

// Cells of the table for each photon: more makes cells emptier, fewer keeps the table in cache.
constexpr std::size_t cells_per_photon = 1;
constexpr std::size_t min_table_size = std::size_t(1) << 12;
constexpr std::size_t max_table_size = std::size_t(1) << 22;
// Photons that are moved whole, through a copy, at most. With more of them the places being written, one a cell, leave the
// cache, and sorting indices is as fast.
constexpr std::size_t most_moved_photons = std::size_t(1) << 21;

// Streams start nine cache lines apart modulo a page: those of one photon would else compete for the same sets
// of the cache when all are written at once.
std::size_t stream_stride(std::size_t photons)
{
    constexpr std::size_t page = 1024, stagger = 9 * 16; // floats
    return (photons + PHOTON_PADDING + page - 1) / page * page + stagger;
}

} // namespace

PhotonGrid make_photon_grid(const Bounds& bounds, float largest_radius, uint table_size, uint stride)
{
    PhotonGrid grid{};
    const Vec3 extent = bounds.extent();
    // Finer than 2^20 cells along an axis a float can no longer tell cells apart.
    const double cell = std::max(2.0 * static_cast<double>(largest_radius), static_cast<double>(max_component(extent)) / (1 << 20));
    const auto cells_along = [&](float length) { return static_cast<uint>(static_cast<double>(length) / cell) + 1; };
    grid.origin = bounds.lower;
    grid.inverse_cell_size = static_cast<float>(1.0 / cell);
    grid.cells_x = cells_along(extent.x);
    grid.cells_y = cells_along(extent.y);
    grid.cells_z = cells_along(extent.z);
    const double cells = static_cast<double>(grid.cells_x) * grid.cells_y * grid.cells_z;
    grid.hashed = cells > static_cast<double>(table_size) ? 1 : 0;
    grid.cell_count = grid.hashed ? table_size : static_cast<uint>(cells);
    grid.stride = stride;
    return grid;
}

float dense_grid_radius(const Bounds& bounds, float radius, uint table_size)
{
    radius = std::max(radius, max_component(bounds.extent()) / (1 << 20));
    while (make_photon_grid(bounds, radius, table_size, 0).hashed) radius *= 1.05f;
    return radius;
}

PhotonMap::PhotonMap(Device& device, const Bounds& bounds, bool keeps_order)
    : device_(&device), bounds_(bounds), keeps_order_(keeps_order), photon_cell_keys_(device, "photon_cell_keys", "Find photon cells"),
      scatter_photons_(device, "scatter_photons", "Sort photons"),
      reorder_photons_(device, "reorder_photons", "Lay out photons", {{{"IN_ORDER", "0"}}, {}}),
      lay_out_sorted_(device, "reorder_photons", "Lay out photons", {{{"IN_ORDER", "1"}}, {}})
{
}

void PhotonMap::reserve(std::size_t photons)
{
    if (sort_ && sort_->capacity() >= photons) return;
    sort_.reset();
    lent_ = {}; // all of them, before asking for more
    streams_ = {};
    sorted_ = {};
    table_size_ = static_cast<uint>(std::clamp(std::bit_ceil(photons * cells_per_photon), min_table_size, max_table_size));
    sort_ = std::make_unique<KeySort>(*device_, photons, table_size_);
    streams_ = Buffer<float>(*device_, PHOTON_STREAMS * stream_stride(photons), "photon streams");
}

Buffer<Photon>& PhotonMap::lend_room(std::size_t count)
{
    reserve(count);
    if (lent_.size() < count) lent_ = streams_.share_as<Photon>(sort_->capacity(), "photon streams, lent");
    return lent_;
}

void PhotonMap::build(const RecordList<Photon>& photons, std::size_t count, float largest_radius)
{
    reserve(photons.capacity());
    grid_ = make_photon_grid(bounds_, largest_radius, table_size_, static_cast<uint>(stream_stride(photons.capacity())));
    fill(photons, count);
}

void PhotonMap::build_dense(const RecordList<Photon>& photons, std::size_t count, float usual_radius)
{
    reserve(photons.capacity());
    const float radius = dense_grid_radius(bounds_, usual_radius, table_size_);
    grid_ = make_photon_grid(bounds_, radius, table_size_, static_cast<uint>(stream_stride(photons.capacity())));
    fill(photons, count);
}

void PhotonMap::fill(const RecordList<Photon>& photons, std::size_t count)
{
    photon_cell_keys_(count, grid_, photons.records(), photons.count(), sort_->keys);
    sort_and_lay_out(photons, count);
}

void PhotonMap::sort_and_lay_out(const RecordList<Photon>& photons, std::size_t count)
{
    const std::size_t eights = (count + 7) / 8;
    if (keeps_order_ || photons.capacity() > most_moved_photons || !sort_->takes_one_pass(grid_.cell_count)) {
        sort_->sort(photons.count(), count, grid_.cell_count);
        reorder_photons_(eights, photons.records(), sort_->order(), photons.count(), grid_.stride, streams_);
        return;
    }
    // Reading photons in sorted order misses the cache at every one; writing them there does not, as long as the
    // places being written, one a cell, fit into it.
    if (!sorted_) sorted_ = Buffer<Photon>(*device_, photons.capacity(), "sorted photons");
    sort_->place(photons.count(), grid_.cell_count);
    scatter_photons_.launch_grouped(sort_->chunks(), 1, photons.records(), sort_->keys, photons.count(), sort_->chunks(), sort_->digits(), sort_->histogram(),
                                    sorted_);
    lay_out_sorted_(eights, sorted_, sort_->order(), photons.count(), grid_.stride, streams_);
}

void bind(ArgumentBinder& binder, const PhotonMap& map)
{
    bind(binder, map.grid());
    bind(binder, map.cell_ends());
    bind(binder, map.cell_ends_offset());
    bind(binder, map.streams());
}

} // namespace sundog
