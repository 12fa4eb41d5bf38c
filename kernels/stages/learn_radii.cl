// Adaptive progressive radii [Kaplanyan and Dachsbacher 2013, section 4]: each pixel learns its estimates' variance and
// bias, and takes the radius whose mean error over all iterations is least. Reads queries, sums and Laplacians; updates
// pixels and adds the photons' estimate to radiance. One work-item a pixel. Used by appm.
//
// An iteration with radius r and M light subpaths has the variance V_1 / (M r^2) and the bias b r^2, b = mu_2 / 2 Delta L.
// Radii r_i = c i^(-1/6), averaged over N iterations, give bias b c^2 3/2 N^(-1/3) and variance V_1 / (M c^2) 3/4 N^(-2/3):
// their squared sum is least at c^6 = V_1 / (6 M b^2).
#include "math/luminance.h"
#include "math/vec3.h"
#include "shared/adaptive_radius.h"
#include "shared/photon.h"

static inline void learn(AdaptivePixel* pixel, float variance, float laplacian, float iterations)
{
    pixel->variance += (variance - pixel->variance) / iterations;
    const float before = laplacian - pixel->laplacian;
    pixel->laplacian += before / iterations;
    pixel->laplacian_deviation += before * (laplacian - pixel->laplacian);
}

// What the squared Laplacian is to be taken for: the mean's square and that of its standard error. Where light is even
// the error alone stays; it lets a radius grow to about half of the one that Laplacians are estimated with.
static inline float squared_laplacian(const AdaptivePixel* pixel, float iterations)
{
    if (iterations < 2.0f) return 0.0f; // nothing is known of the error yet
    return pixel->laplacian * pixel->laplacian + pixel->laplacian_deviation / (iterations * (iterations - 1.0f));
}

__kernel void learn_radii(__global const GatherQuery* restrict queries, __global const MomentSum* restrict sums, __global const GatherSum* restrict laplacians,
                          AdaptiveSchedule schedule, uint count, __global AdaptivePixel* restrict pixels, __global Vec3* restrict radiance)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    AdaptivePixel pixel = pixels[index];
    float variance = 0.0f, laplacian = 0.0f;
    if (queries[index].radius > 0.0f) {
        const float3 throughput = unpack(queries[index].throughput);
        radiance[index] = pack(unpack(radiance[index]) + throughput * unpack(sums[index].irradiance) / schedule.light_subpaths);
        variance = pixel.radius_squared * sums[index].second_moment / schedule.light_subpaths;
        laplacian = dot(throughput * unpack(laplacians[index].flux), LUMINANCE_WEIGHTS) / schedule.light_subpaths;
    }
    if (isfinite(variance) && isfinite(laplacian)) learn(&pixel, variance, laplacian, schedule.iterations);

    const float bias = 0.25f * schedule.second_moment * schedule.second_moment * squared_laplacian(&pixel, schedule.iterations); // b^2
    const float c_cubed = sqrt(pixel.variance / (6.0f * schedule.light_subpaths * bias));
    const float radius = cbrt(c_cubed / sqrt(schedule.iterations + 1.0f));
    // Nothing learned (0 / 0, or no bias) asks for the largest radius.
    const float allowed = radius < schedule.largest_radius ? fmax(radius, schedule.smallest_radius) : schedule.largest_radius;
    pixel.radius_squared = allowed * allowed;
    pixels[index] = pixel;
}
