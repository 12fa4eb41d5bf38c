// What light subpaths bring to the film.
#pragma once

#include "shared/film.h"
#include "stages/key_sort.h"
#include "stages/path_pool.h"

#include <memory>
#include <optional>

namespace sundog
{

class LensSplats
{
public:
    // paths: light subpaths an iteration; pixels: of the crop.
    LensSplats(Device& device, const DeviceScene& scene, std::size_t paths, std::size_t pixels);

    // To be written by a shading stage: shadow rays to the lens by path, splats by item of the pool's active list.
    Buffer<Ray>& shadow_rays() { return shadow_.rays; }
    Buffer<Splat> deposits;

    void clear();

    // Keeps the splats whose shadow ray is free.
    void collect(const DeviceScene& scene, PathPool& pool);

    // Waits. False: some found no room, and there is room now for another try with the same paths.
    bool complete();

    // Adds them, over the number of light subpaths, to radiance by path of the camera: sorted by pixel and in path order, so that
    // the bits are the same every time.
    void add_to(Buffer<Vec3>& radiance);

    // Also keeps which path each splat is of, and what all of a path's together count for as one number.
    void keep_owners();
    const RecordList<Splat>& splats() const { return splats_; }
    std::size_t stored() const { return stored_; } // complete
    const Buffer<uint>& owners() const { return owners_->paths.records(); }
    // kernels/math/scalar_contribution.h, by path, over the number of pixels: as a mean of the film.
    Buffer<float>& contributions() { return owners_->contributions; }

    void serialize(StateArchive& archive);

private:
    struct Owners {
        RecordList<uint> paths;
        Buffer<float> contributions;
        Kernel add_splat_contributions;
    };

    void reserve_sort();

    Device* device_;
    float inverse_paths_;
    std::size_t pixels_, stored_ = 0;
    Kernel flag_unoccluded_, splat_pixel_keys_, add_splats_;
    ShadowRays shadow_;
    Buffer<uint> flags_;
    RecordList<Splat> splats_;
    std::optional<Owners> owners_;
    std::unique_ptr<KeySort> sort_;
};

} // namespace sundog
