// What tests of surfaces share: surfaces at hits, and what rays that leave them hit.
#pragma once

#include "stages/device_scene.h"
#include "support/device_fixture.h"

#include <numeric>
#include <vector>

namespace sundog
{

class SurfaceFixture : public DeviceFixture
{
protected:
    // One entry a ray; of rays that hit nothing, only the hits mean something.
    struct Surfaces {
        std::vector<Hit> first, reflected, passed; // of the rays, and of rays from there, mirrored and straight on
        std::vector<Vec3> positions, geometric_normals, shading_normals, outgoing, dpdu, dpdv;
    };

    std::vector<Hit> trace(const DeviceScene& scene, const Buffer<Ray>& rays)
    {
        const uint count = static_cast<uint>(rays.size());
        std::vector<uint> active(count);
        std::iota(active.begin(), active.end(), 0u);
        const auto hits = allocate<Hit>(count);
        Kernel(device_, "trace_closest", "Trace", scene.trace_options())(count, scene.geometry(), rays, hits, upload(active),
                                                                         upload(std::vector{count}));
        return hits.download();
    }

    Surfaces follow(const DeviceScene& scene, const std::vector<Ray>& rays)
    {
        const uint count = static_cast<uint>(rays.size());
        const Kernel kernel = test_kernel(R"(
            #include "scene/surface.h"
            __kernel void test(SURFACE_PARAMETERS, uint count, __global const Ray* rays, __global const Hit* hits, __global Vec3* vectors, __global Ray* reflected,
                               __global Ray* passed)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                reflected[i] = passed[i] = no_ray();
                if (hits[i].primitive == NO_PRIMITIVE) return;
                const SurfaceView scene = SURFACE_VIEW;
                const Surface surface = surface_at(&scene, rays[i], hits[i]);
                const float3 n = surface.geometric_normal, o = surface.outgoing;
                vectors[i] = pack(surface.position);
                vectors[count + i] = pack(n);
                vectors[2u * count + i] = pack(surface.shading_normal);
                vectors[3u * count + i] = pack(o);
                vectors[4u * count + i] = pack(surface.dpdu);
                vectors[5u * count + i] = pack(surface.dpdv);
                reflected[i] = ray_from(&surface, 2.0f * dot(o, n) * n - o);
                passed[i] = ray_from(&surface, -o);
            })",
                                          scene.trace_options()); // with instances or without; all that a surface can tell
        const auto device_rays = upload(rays);
        Surfaces result;
        result.first = trace(scene, device_rays);
        const auto vectors = allocate<Vec3>(std::size_t(6) * count);
        const auto reflected = allocate<Ray>(count), passed = allocate<Ray>(count);
        kernel(count, scene.surfaces(), count, device_rays, upload(result.first), vectors, reflected, passed);
        result.reflected = trace(scene, reflected);
        result.passed = trace(scene, passed);
        std::vector<Vec3>* parts[] = {&result.positions, &result.geometric_normals, &result.shading_normals, &result.outgoing, &result.dpdu,
                                      &result.dpdv};
        for (std::size_t i = 0; i < std::size(parts); i++) *parts[i] = vectors.download(i * count, count);
        return result;
    }
};

} // namespace sundog
