// The end-to-end part of `sundog bench`: whole iterations, kernel builds, the host's share, and memory.
#pragma once

#include "device/device.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>

namespace sundog {

struct RenderFigures {
    double setup_seconds = 0.0; // scene, hierarchy, kernels, first iteration
    double kernel_seconds = 0.0; // of that, building kernels
    double iterations_per_second = 0.0; // by wall time
    double host_share = 0.0; // of an iteration's wall time during which no kernel ran
    double peak_bytes = 0.0;
};

// Renders `scene` with `photons` light subpaths an iteration for about `iterations` iterations.
RenderFigures bench_render(Device& device, const Scene& scene, const std::string& method, std::uint64_t photons, int max_depth, int iterations);

enum class BenchFloor { diffuse, glossy };

// The Cornell box with a glass and a mirror sphere, as scenes/gallery/cornell-glass.xml, without a file.
Scene cornell_glass_scene(int width, int height, BenchFloor floor = BenchFloor::diffuse);

} // namespace sundog
