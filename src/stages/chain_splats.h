// What the samples of Markov chains bring to the film. A sample is known to weigh only when its chain has left it: splats are kept
// until then, each with its sample's number.
#pragma once

#include "stages/camera_paths.h"
#include "stages/key_sort.h"
#include "stages/lens_splats.h"
#include "stages/markov_chains.h"

#include <memory>

namespace sundog
{

class ChainSplats
{
public:
    // pixels: of the film; capacity: splats that are kept at first.
    ChainSplats(Device& device, std::size_t pixels, std::size_t capacity);

    bool has_room_for(std::size_t splats) const { return count_ + splats <= splats_.size(); }
    void reserve(std::size_t splats); // so many more
    void clear() { count_ = 0; }

    // Of samples numbered first_sample + chain (stages/markov_chains.h): the radiance of each one's camera path, and the splats of
    // each one's light subpath. There has to be room.
    void leave_camera_splats(uint first_sample, const CameraPaths& camera);
    void leave_light_splats(uint first_sample, const LensSplats& lens);

    // Adds all of them, times their weights (chain and independent) and scale, by pixel in the film's order, sorted so that the bits
    // are the same every time. Then keeps those of the chains' current states, for MarkovChains::renumber_samples() to follow.
    void add_to(Buffer<Vec3>& radiance, Buffer<Vec3>& chain_radiance, const MarkovChains& chains, float scale);

    void serialize(StateArchive& archive, const MarkovChains& chains); // after these

private:
    void allocate(std::size_t capacity);
    void keep_current(const MarkovChains& chains);

    Device* device_;
    std::size_t pixels_, count_ = 0;
    Kernel leave_camera_splats_, leave_light_splats_, splat_pixel_keys_, add_weighted_splats_, flag_current_splats_, keep_splats_;
    Buffer<Splat> splats_, next_splats_;
    Buffer<uint> samples_, next_samples_, flags_, device_count_, kept_count_;
    std::unique_ptr<Compaction> compaction_;
    std::unique_ptr<KeySort> sort_;
};

} // namespace sundog
