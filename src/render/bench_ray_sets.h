// Scenes and rays that bench_rays measures, and Embree as its opponent.
#pragma once

#include "scene/scene.h"
#include "shared/ray.h"

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <vector>

namespace sundog
{

struct BenchScene {
    std::string name;
    TriangleMesh mesh;
    Vec3 eye, target;
    float tan_half_view;
    float lamp_height, lamp_half_size; // horizontal square lamp about the y axis, light below
};

// About ten thousand triangles: two spheres in a box.
BenchScene small_bench_scene();
// About a million: rough terrain with spheres above it, in a box.
BenchScene large_bench_scene();

// Embree's own hierarchy of high quality, with its default flags unless told otherwise, and its single-ray
// functions on all hardware threads.
class EmbreeTracer
{
public:
    explicit EmbreeTracer(const TriangleMesh& mesh, RTCSceneFlags flags = RTC_SCENE_FLAG_NONE);
    void closest(const std::vector<Ray>& rays, std::vector<Hit>& hits) const; // u, v as in Hit
    void any(const std::vector<Ray>& rays, std::vector<uint>& occluded) const;

private:
    struct Release {
        void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
        void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
    };
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
};

// 1024 x 1024 rays each: from the eye in scanline order, diffusely reflected where those hit, reflected photons
// from the lamp, and from the camera's hits to points on the lamp.
struct BenchRays {
    std::vector<Ray> camera, bounce, photon, shadow;
};
BenchRays bench_ray_sets(const BenchScene& scene, const EmbreeTracer& tracer);

} // namespace sundog
