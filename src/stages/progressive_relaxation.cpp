#include "stages/progressive_relaxation.h"

#include "stages/photon_check.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sundog
{

namespace
{

constexpr double largest_flux = 1e38; // W, that a float holds

// Photons whose flux is their index, for find_nearest_photons.
std::vector<Photon> numbered(std::vector<Photon> photons)
{
    for (std::size_t i = 0; i < photons.size(); i++) photons[i].flux = {static_cast<float>(i & 0xffffu), static_cast<float>(i >> 16), 0.0f};
    return photons;
}

} // namespace

ProgressiveRelaxation::ProgressiveRelaxation(Device& device, float largest_radius, float least_cosine)
    : device_(device), largest_radius_(largest_radius), least_cosine_(least_cosine),
      relaxation_(device, largest_radius, least_cosine, RelaxedTo::equal_flux),
      find_nearest_photons_(device, "find_nearest_photons", "Find nearest primal photons")
{
}

std::vector<uint> ProgressiveRelaxation::nearest_primal(const std::vector<Photon>& photons)
{
    if (photons.empty() || primal_.empty()) return std::vector<uint>(photons.size(), NO_NEAREST_PHOTON);
    const Bounds bounds = bounds_of(primal_);
    RecordList<Photon> records(device_, "photons", primal_.size());
    records.assign(numbered(primal_));
    const float usual = radius_of_photons(bounds, primal_.size(), 1.0, largest_radius_);
    PhotonMap map(device_, bounds);
    map.build_dense(records, primal_.size(), usual);
    const Buffer<Photon> fresh(device_, photons, "fresh photons");
    const Buffer<uint> nearest(device_, photons.size(), "nearest photons");
    find_nearest_photons_(photons.size(), map.grid(), map.cell_ends(), map.cell_ends_offset(), map.streams(),
                          Relaxation{usual, largest_radius_, least_cosine_, 1.0f}, fresh, static_cast<uint>(photons.size()), nearest);
    return nearest.download();
}

void ProgressiveRelaxation::add_pass(const std::vector<Photon>& photons)
{
    const std::vector<uint> nearest = nearest_primal(photons);
    for (std::size_t i = 0; i < photons.size(); i++) {
        const Vec3 flux = photons[i].flux;
        if (nearest[i] != NO_NEAREST_PHOTON) {
            Double3& sum = sums_[nearest[i]];
            sum = {sum[0] + flux.x, sum[1] + flux.y, sum[2] + flux.z};
        } else {
            primal_.push_back(photons[i]);
            sums_.push_back({flux.x, flux.y, flux.z});
        }
    }
    passes_++;
    for (std::size_t i = 0; i < primal_.size(); i++) {
        const auto mean = [&](std::size_t c) { return static_cast<float>(sums_[i][c] / static_cast<double>(passes_)); };
        primal_[i].flux = {mean(0), mean(1), mean(2)};
    }
    // By as much as this pass is of all: flux that has come moves with its photon, and what is to come would take as long to
    // undo that. So the map comes to rest.
    relaxation_.relax(primal_, 1, 1.0f / static_cast<float>(passes_));
}

void ProgressiveRelaxation::serialize(StateArchive& archive, const Bounds& bounds)
{
    if (!archive.takes_blocks()) return;
    archive.count("relaxation passes", passes_);
    if (archive.loading()) {
        const std::uint64_t bytes = archive.next_bytes();
        archive.check(bytes % sizeof(Photon) == 0, "primal photons");
        primal_.resize(static_cast<std::size_t>(bytes / sizeof(Photon)));
        sums_.resize(primal_.size());
    }
    archive.bytes("primal photons", std::as_writable_bytes(std::span(primal_)));
    archive.bytes("primal flux", std::as_writable_bytes(std::span(sums_)));
    for (const Photon& photon : primal_) archive.check(is_photon(photon, bounds), "primal photons");
    for (const Double3& sum : sums_)
        archive.check(std::all_of(sum.begin(), sum.end(), [](double flux) { return std::abs(flux) < largest_flux; }), "primal flux");
}

} // namespace sundog
