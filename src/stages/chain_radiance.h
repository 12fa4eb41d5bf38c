// What Markov chains bring to the film is known up to a factor, the mean contribution b, of which every iteration knows more.
#pragma once

#include "base/state_archive.h"
#include "device/kernel.h"
#include "shared/film.h"

#include <vector>

namespace sundog
{

class ChainRadiance
{
public:
    ChainRadiance(Device& device, std::size_t pixels);

    Buffer<Vec3> radiance; // of this iteration by pixel, without the factor; to be added to

    // Adds it, times the factor as known now, to the film's radiance, and clears it.
    void add_to(Buffer<Vec3>& film_radiance, double factor);

    // Nothing that was added so far depends on factors to come: `factor` is its last one. film_radiance: stays as it is.
    void settle(double factor, Buffer<Vec3>& film_radiance);

    double factor() const { return factor_; } // of the last iteration

    // Sum over iterations, of `count` pixels from `first` on, of what would have been added with `factor` in place of those that were known: the film's mean
    // lacks it. Waits.
    std::vector<Vec3> correction(double factor, std::size_t first, std::size_t count) const;

    void serialize(StateArchive& archive);

private:
    Kernel add_chain_radiance_;
    Buffer<DirectSum> sum_, correction_;
    double factor_ = 0.0; // of the last iteration
};

} // namespace sundog
