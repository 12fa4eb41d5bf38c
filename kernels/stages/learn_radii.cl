// Adaptive progressive radii [Kaplanyan and Dachsbacher 2013, section 4]: each pixel learns its estimates' variance and
// bias, and takes the radius whose mean error over all iterations is least. Reads queries and what their wide disks tell
// of errors; updates pixels. One work-item a pixel. Used with radius_policy=adaptive.
//
// An iteration with radius r and M light subpaths has the variance V_1 / (M r^2), V_1 = R E[(beta f Phi)^2] p, and the bias
// b r^2, b = mu_2 / 2 Delta L. Radii r_i = c i^(-1/6), averaged over N iterations, give the bias b c^2 3/2 N^(-1/3) and the
// variance V_1 / (M c^2) 3/4 N^(-2/3): their squared sum is least at c^6 = V_1 / (6 M b^2).
#include "math/luminance.h"
#include "math/vec3.h"
#include "shared/adaptive_radius.h"
#include "shared/photon.h"

// Fewer photons tell nothing of either.
#define LEAST_PHOTONS 16.0f

static inline void learn(AdaptivePixel* pixel, float second_moment, float laplacian, float photons, float iterations)
{
    pixel->second_moment += (second_moment - pixel->second_moment) / iterations;
    const float before = laplacian - pixel->laplacian;
    pixel->laplacian += before / iterations;
    pixel->laplacian_deviation += before * (laplacian - pixel->laplacian);
    pixel->photons += photons;
}

// What the squared Laplacian is to be taken for: the mean's square and that of its standard error. Where light is even
// the error alone stays; it lets a radius grow to about half of the one that Laplacians are estimated with.
static inline float squared_laplacian(const AdaptivePixel* pixel, float iterations)
{
    return pixel->laplacian * pixel->laplacian + pixel->laplacian_deviation / (iterations * (iterations - 1.0f));
}

static inline float best_radius(const AdaptivePixel* pixel, AdaptiveSchedule schedule)
{
    if (schedule.iterations < 2.0f || pixel->photons < LEAST_PHOTONS) return schedule.largest_radius;
    const float variance = schedule.kernel_square * pixel->second_moment;
    const float squared_bias = 0.25f * schedule.kernel_moment * schedule.kernel_moment * squared_laplacian(pixel, schedule.iterations);
    const float c_cubed = sqrt(variance / (6.0f * schedule.light_subpaths * squared_bias));
    const float radius = cbrt(c_cubed / sqrt(schedule.iterations + 1.0f));
    // No bias, and 0 / 0, ask for the largest.
    return radius < schedule.largest_radius ? fmax(radius, schedule.smallest_radius) : schedule.largest_radius;
}

__kernel void learn_radii(__global const GatherQuery* restrict queries, __global const ErrorSum* restrict errors, AdaptiveSchedule schedule, uint count,
                          __global AdaptivePixel* restrict pixels)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    AdaptivePixel pixel = pixels[index];
    float second_moment = 0.0f, laplacian = 0.0f, photons = 0.0f;
    if (queries[index].radius > 0.0f) {
        const float3 throughput = unpack(queries[index].throughput);
        second_moment = errors[index].second_moment / schedule.light_subpaths;
        laplacian = dot(throughput * unpack(errors[index].laplacian), LUMINANCE_WEIGHTS) / schedule.light_subpaths;
        photons = errors[index].photons;
    }
    if (isfinite(second_moment) && isfinite(laplacian)) learn(&pixel, second_moment, laplacian, photons, schedule.iterations);
    const float radius = best_radius(&pixel, schedule);
    pixel.radius_squared = radius * radius;
    pixels[index] = pixel;
}
