// The ray part of `sundog bench`: trace_closest and trace_any against Embree's single-ray functions.
#pragma once

#include "device/kernel.h"
#include "scene/bvh_build.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace sundog
{

// One ray set on one scene. Rates are medians over the rounds.
struct RayFigure {
    std::string scene; // "small" or "large"
    std::string rays;  // "camera", "bounce", "photon" (closest hit) or "shadow" (any hit)
    std::size_t triangles = 0;
    double mrays = 0.0;            // million rays a second, of the device
    double embree_mrays = 0.0;     // of Embree with one thread a hardware thread
    double ratio = 0.0;            // median of the rounds' ratios of neighbouring measurements
    std::size_t disagreements = 0; // rays that hit in one and miss in the other, or at t off by 1e-3
};

struct RayBenchSettings {
    int rounds = 5;
    bool with_large_scene = true;
    BvhSettings bvh;
    BuildOptions options; // in addition to what the scene needs: to compare variants
};

// On a CPU device both sides count CPU seconds divided by the hardware threads, so that other processes do
// not spoil the figures; on others wall seconds. Takes under a minute with the large scene.
std::vector<RayFigure> bench_rays(Device& device, const RayBenchSettings& settings = {});

} // namespace sundog
