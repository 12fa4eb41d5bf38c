#include "stages/lens_splats.h"

#include <algorithm>

namespace sundog
{

LensSplats::LensSplats(Device& device, const DeviceScene& scene, std::size_t paths, std::size_t pixels)
    : deposits(device, paths, "splat deposits"), device_(&device), inverse_paths_(1.0f / static_cast<float>(paths)), pixels_(pixels),
      flag_unoccluded_(device, "flag_unoccluded", "Flag free splats"), splat_pixel_keys_(device, "splat_pixel_keys", "Find splat pixels"),
      add_splats_(device, "add_splats", "Add splats"), shadow_(device, scene, paths, false), flags_(device, paths, "splat flags"),
      splats_(device, "splats", paths)
{
}

void LensSplats::keep_owners()
{
    owners_.emplace(Owners{RecordList<uint>(*device_, "splat owners", splats_.capacity()),
                           Buffer<float>(*device_, deposits.size(), "splat contributions"),
                           Kernel(*device_, "add_splat_contributions", "Sum splat contributions")});
}

void LensSplats::clear()
{
    splats_.clear();
    if (!owners_) return;
    owners_->paths.clear();
    owners_->contributions.fill(0.0f);
}

void LensSplats::serialize(StateArchive& archive)
{
    splats_.serialize(archive);
    if (!owners_) return;
    owners_->paths.serialize(archive);
    archive.check(owners_->paths.capacity() == splats_.capacity(), "splat owners capacity");
}

void LensSplats::collect(const DeviceScene& scene, PathPool& pool)
{
    shadow_.trace(scene, pool);
    flag_unoccluded_(pool.items(), pool.active(), pool.active_count(), shadow_.occluded, flags_);
    splats_.append(pool.compaction, deposits, flags_, pool.active_count(), pool.items());
    if (!owners_) return;
    owners_->paths.append(pool.compaction, pool.active(), flags_, pool.active_count(), pool.items());
    owners_->add_splat_contributions(pool.items(), deposits, flags_, pool.active(), pool.active_count(), 1.0f / static_cast<float>(pixels_),
                                     owners_->contributions);
}

bool LensSplats::complete()
{
    stored_ = splats_.read_count();
    if (stored_ <= splats_.capacity()) return true;
    splats_.grow(stored_);
    if (owners_) owners_->paths.grow(stored_);
    return false;
}

void LensSplats::add_to(Buffer<Vec3>& radiance)
{
    reserve_sort();
    splat_pixel_keys_(stored_, splats_.records(), splats_.count(), sort_->keys);
    sort_->sort(splats_.count(), stored_, static_cast<uint>(std::max<std::size_t>(pixels_, 2)));
    add_splats_(pixels_, splats_.records(), sort_->order(), sort_->ends(), sort_->ends_offset(), static_cast<uint>(pixels_), inverse_paths_,
                radiance);
}

void LensSplats::reserve_sort()
{
    if (sort_ && sort_->capacity() >= splats_.capacity()) return;
    sort_.reset();
    sort_ = std::make_unique<KeySort>(*device_, splats_.capacity(), static_cast<uint>(std::max<std::size_t>(pixels_, 2)));
}

} // namespace sundog
