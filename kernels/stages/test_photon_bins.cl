// Chi-squared progressive radii [Lin et al. 2020]: a pixel keeps its radius while the photons in its disk look as if
// they lay evenly. Reads queries, sums and thresholds; updates pixels and adds the photons' estimate to radiance. One
// work-item a pixel. Used with radius_policy=chi_squared.
//
// The paper tests the same growing counts again and again, and so fails sooner or later whatever they are. Here they are
// tested when their number has doubled, and test k at the level a / ((k + 1) (k + 2)): all tests together reject
// what is even with a probability of at most a. [After Pocock 1977, Biometrika 64(2), which shows the inflation.]
#include "math/vec3.h"
#include "shared/binned_photons.h"
#include "shared/photon.h"

// Pearson's statistic of counts that should be equal.
static inline float chi_squared_of(const uint* bins, uint count)
{
    float sum = 0.0f, squares = 0.0f;
    for (uint i = 0u; i < count; ++i) sum += (float)bins[i];
    for (uint i = 0u; i < count; ++i) squares += ((float)bins[i] - sum / (float)count) * ((float)bins[i] - sum / (float)count);
    return sum > 0.0f ? squares * (float)count / sum : 0.0f;
}

// A smaller radius starts afresh, and waits for more photons: with next = first / shrink^2 a pixel whose every test
// fails has r^2 ~ N^(-1/3), the optimal rate.
static inline void shrink_radius(TestedPixel* pixel, float factor, float shrink)
{
    pixel->radius_squared *= factor;
    pixel->first_test = pixel->first_test / (shrink * shrink);
    pixel->next_test = pixel->first_test;
    pixel->tests = 0u;
    for (uint i = 0u; i < DISK_BINS; ++i) pixel->bins[i] = 0u;
}

__kernel void test_photon_bins(__global const GatherQuery* restrict queries, __global const BinnedSum* restrict sums,
                               __global const TestThreshold* restrict thresholds, uint count, float shrink, float inverse_paths,
                               __global TestedPixel* restrict pixels, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count || queries[index].radius == 0.0f) return;
    TestedPixel pixel = pixels[index];
    const BinnedSum sum = sums[index];
    radiance[index] = pack(unpack(radiance[index]) + unpack(queries[index].throughput) * unpack(sum.irradiance) * inverse_paths);

    float photons = 0.0f;
    for (uint i = 0u; i < DISK_BINS; ++i) {
        pixel.bins[i] += sum.bins[i];
        photons += (float)pixel.bins[i];
    }
    if (photons >= pixel.next_test) {
        const TestThreshold threshold = thresholds[min(pixel.tests, TEST_THRESHOLDS - 1u)];
        if (chi_squared_of(pixel.bins, DISK_BINS) <= threshold.disk) {
            pixel.tests++;
            pixel.next_test = 2.0f * photons;
        } else {
            // An inner ring that is even is a disk that may be kept: half the area.
            shrink_radius(&pixel, chi_squared_of(pixel.bins, RING_BINS) <= threshold.inner_ring ? 0.5f : shrink, shrink);
        }
    }
    pixels[index] = pixel;
}
