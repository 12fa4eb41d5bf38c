// Photons survive by importance [Peter and Pietrek 1998]: with a probability that is the number of importons around them over
// `enough`, from `least` to 1, by which the survivors' flux is divided, so that the light stays the same in the mean. Reads
// `count` photons from `first` on and what was found around each; writes survivors and flags them. One work-item a photon. Used by
// photonmapper.
#include "math/hash.h"
#include "math/philox.h"
#include "math/vec3.h"
#include "shared/path.h"
#include "shared/photon.h"
#include "shared/sampler.h"

__kernel void thin_photons(__global const Photon* restrict photons, uint first, uint photon_count, __global const GatherSum* restrict importons, SamplerKey key,
                           float enough, float least, uint count, __global Photon* restrict survivors, __global uint* restrict flags)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    flags[index] = PATH_ENDED;
    if (first + index >= photon_count) return;
    const float survival = clamp(importons[index].count / enough, least, 1.0f);
    const uint4 counter = (uint4)(first + index, key.iteration_low, key.iteration_high, STREAM_THINNING << 28);
    const float u = unit_float4(philox4x32(counter, (uint2)(key.seed_low, key.seed_high))).x;
    if (!(u < survival)) return;
    Photon photon = photons[first + index];
    photon.flux = pack(unpack(photon.flux) / survival);
    survivors[index] = photon;
    flags[index] = PATH_DEPOSIT;
}
