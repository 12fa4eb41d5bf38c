// Progressive statistics of each pixel: shrinks the radius by the photons found and rescales the flux
// [Hachisuka and Jensen 2009, eqs. 7 to 9]. Reads queries, sums and `direct`, the radiance that is not from photons;
// updates pixels, sums up `direct` where it varies (-D SUMS_DIRECT=1), and adds this iteration's own photon estimate to
// radiance, which may be `direct`, and direct_share of `direct`. One work-item a pixel. Used by ppm and sppm.
#include "density/photon_count.h"
#include "shared/film.h"
#include "shared/photon.h"

#define PI 3.14159265358979f

__kernel void update_progressive_pixels(__global const GatherQuery* restrict queries, __global const GatherSum* restrict sums, __global const Vec3* direct, uint count,
                                        float alpha, float inverse_paths, float direct_share, __global ProgressivePixel* restrict pixels,
                                        __global DirectSum* restrict direct_sums, __global Vec3* radiance)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    ProgressivePixel pixel = pixels[index];
    const float found = sums[index].count;
    const float3 other = unpack(direct[index]);
    if (SUMS_DIRECT && is_finite3(other)) {
        DirectSum sum = direct_sums[index];
        add_compensated3(&sum.sum, &sum.error, other);
        direct_sums[index] = sum;
    }
    if (direct_share > 0.0f) radiance[index] = pack(unpack(radiance[index]) + direct_share * other);
    const float3 flux = unpack(queries[index].throughput) * unpack(sums[index].flux); // beta Psi
    if (queries[index].radius > 0.0f && found > 0.0f) radiance[index] = pack(unpack(radiance[index]) + flux * (inverse_paths / (PI * pixel.radius_squared)));
    // What is not finite stays out of the statistics; the film counts it.
    if (queries[index].radius > 0.0f && found > 0.0f && is_finite3(flux)) {
        const float shrink = keep_photons(&pixel.count, &pixel.count_error, found, alpha); // (7)
        pixel.radius_squared *= shrink; // (8)
        pixel.tau = pack((unpack(pixel.tau) + flux) * shrink); // (9)
    }
    pixels[index] = pixel;
}
