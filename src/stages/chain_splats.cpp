#include "stages/chain_splats.h"

#include "math/plausible.h"

#include <algorithm>
#include <cassert>

namespace sundog
{

namespace
{

constexpr float largest_splat = 1e24f; // so that many of them, times their weights, add up to no more than radiance may

} // namespace

ChainSplats::ChainSplats(Device& device, std::size_t pixels, std::size_t capacity)
    : device_(&device), pixels_(pixels), leave_camera_splats_(device, "leave_camera_splats", "Leave camera splats"),
      leave_light_splats_(device, "leave_light_splats", "Leave light splats"),
      splat_pixel_keys_(device, "splat_pixel_keys", "Find splat pixels"), add_weighted_splats_(device, "add_weighted_splats", "Add splats"),
      flag_current_splats_(device, "flag_current_splats", "Flag current splats"),
      keep_splats_(device, "keep_splats", "Keep current splats"), device_count_(device, 1, "splat count"),
      kept_count_(device, 1, "kept splat count")
{
    allocate(capacity);
}

void ChainSplats::allocate(std::size_t capacity)
{
    splats_ = Buffer<Splat>(*device_, capacity, "chain splats");
    next_splats_ = Buffer<Splat>(*device_, capacity, "chain splats");
    samples_ = Buffer<uint>(*device_, capacity, "splat samples");
    next_samples_ = Buffer<uint>(*device_, capacity, "splat samples");
    flags_ = Buffer<uint>(*device_, capacity, "splat flags");
    compaction_ = std::make_unique<Compaction>(*device_, capacity);
    sort_ = std::make_unique<KeySort>(*device_, capacity, static_cast<uint>(std::max<std::size_t>(pixels_, 2)));
}

void ChainSplats::reserve(std::size_t splats)
{
    if (has_room_for(splats)) return;
    const std::vector<Splat> kept_splats = splats_.download(0, count_);
    const std::vector<uint> kept_samples = samples_.download(0, count_);
    const std::size_t needed = count_ + splats;
    splats_ = {}; // give back before asking for more
    next_splats_ = {};
    sort_.reset();
    allocate(needed + needed / 2);
    splats_.upload(kept_splats);
    samples_.upload(kept_samples);
}

void ChainSplats::leave_camera_splats(uint first_sample, const CameraPaths& camera)
{
    assert(has_room_for(camera.count()));
    leave_camera_splats_(camera.count(), camera.radiance, camera.pixels, static_cast<uint>(camera.count()), static_cast<uint>(count_),
                         first_sample, splats_, samples_);
    count_ += camera.count();
}

void ChainSplats::leave_light_splats(uint first_sample, const LensSplats& lens)
{
    assert(has_room_for(lens.stored()));
    leave_light_splats_(lens.stored(), lens.splats().records(), lens.owners(), static_cast<uint>(lens.stored()),
                        1.0f / static_cast<float>(pixels_), static_cast<uint>(count_), first_sample, splats_, samples_);
    count_ += lens.stored();
}

void ChainSplats::add_to(Buffer<Vec3>& radiance, Buffer<Vec3>& chain_radiance, const MarkovChains& chains, float scale)
{
    device_count_.fill(static_cast<uint>(count_));
    splat_pixel_keys_(count_, splats_, device_count_, sort_->keys);
    sort_->sort(device_count_, count_, static_cast<uint>(std::max<std::size_t>(pixels_, 2)));
    add_weighted_splats_(pixels_, splats_, samples_, chains.weights(), sort_->order(), sort_->ends(), sort_->ends_offset(),
                         static_cast<uint>(pixels_), scale, radiance, chain_radiance);
    keep_current(chains);
}

void ChainSplats::keep_current(const MarkovChains& chains)
{
    const uint chain_count = static_cast<uint>(chains.count()), chunks = static_cast<uint>(Compaction::chunks_of(count_));
    flag_current_splats_(count_, chains.states(), chain_count, samples_, static_cast<uint>(count_), flags_);
    kept_count_.fill(0);
    const Buffer<uint>& starts = compaction_->append_places(flags_, device_count_, count_, PATH_DEPOSIT, kept_count_);
    keep_splats_(chunks, splats_, samples_, flags_, static_cast<uint>(count_), chunks, starts, chain_count, next_splats_, next_samples_);
    std::swap(splats_, next_splats_);
    std::swap(samples_, next_samples_);
    count_ = kept_count_.read(0);
}

void ChainSplats::serialize(StateArchive& archive, const MarkovChains& chains)
{
    if (!archive.takes_blocks()) return;
    std::uint64_t count = count_, capacity = splats_.size();
    archive.value("chain splat count", count);
    // When it is full splats are added, and so in another order.
    archive.capacity("chain splat capacity", capacity, sizeof(Splat), device_->info().largest_buffer_bytes);
    archive.check(count <= capacity, "chain splat count");
    if (capacity != splats_.size()) allocate(capacity);
    count_ = count;
    std::vector<Splat> splats = archive.loading() ? std::vector<Splat>(count_) : splats_.download(0, count_);
    std::vector<uint> samples = archive.loading() ? std::vector<uint>(count_) : samples_.download(0, count_);
    archive.bytes("chain splats", std::as_writable_bytes(std::span(splats)));
    archive.bytes("splat samples", std::as_writable_bytes(std::span(samples)));
    if (!archive.loading()) return;
    for (const Splat& splat : splats) archive.check(splat.pixel < pixels_ && is_plausible(splat.radiance, largest_splat), "chain splats");
    for (const uint sample : samples) archive.check(sample < chains.count(), "splat samples");
    splats_.upload(splats);
    samples_.upload(samples);
}

} // namespace sundog
