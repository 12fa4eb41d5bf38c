// Parameters that many methods share, so that they mean the same everywhere.
#pragma once

#include "math/bounds.h"
#include "methods/parameters.h"
#include "scene/light_tree.h"
#include "shared/camera.h"
#include "shared/path.h"
#include "stages/sampling.h"

namespace sundog {

ParameterSpec iterations_spec();
ParameterSpec max_depth_spec();
ParameterSpec rr_depth_spec(int default_depth, const std::string& paths);
ParameterSpec rr_depth_of_paths_spec(); // of a method whose parameter `paths` says whose paths it has
ParameterSpec sampler_spec();
ParameterSpec photons_spec();
ParameterSpec radius_spec();
ParameterSpec alpha_spec();
ParameterSpec direct_spec();
ParameterSpec light_choice_spec();
ParameterSpec kernel_spec(const std::string& default_kernel = "epanechnikov");
ParameterSpec filter_kernel_spec(); // with the filters of photon maps, for methods that need not know a kernel's moments
ParameterSpec spectral_spec();

constexpr int rr_depth_of_paths = 5;
constexpr int rr_depth_of_subpaths = 2;

PathRules path_rules(const Parameters& parameters); // of max_depth and rr_depth
SamplerKind sampler_kind(const Parameters& parameters);
// By power for methods that have no such parameter. Refuses a choice that would do nothing: without next-event estimation.
LightSelection light_selection(const Parameters& parameters);
bool is_spectral(const Parameters& parameters); // false for methods that have no such parameter
int density_kernel(const Parameters& parameters); // as DENSITY_KERNEL

// Light subpaths an iteration: `photons`, or one a pixel.
std::size_t light_path_count(const Parameters& parameters, std::size_t pixels);

// Width (scene units) of a pixel where the camera sees the middle of the scene.
float pixel_footprint(const Camera& camera, const Bounds& scene);

// Pixels across a query's radius at most: a larger one blurs what a longer render would have to sharpen again.
constexpr double usual_target_pixels = 4.0;

// A parameter that is a radius, 0 where it is left to the method. Refuses one below what single-precision coordinates of a scene of
// that radius tell apart: no photon would ever be within, and its square could be 0.
double given_radius(const Parameters& parameters, const std::string& name, float scene_radius);

// `radius`, or, when that is 0, the smaller of two: one within which a query finds a handful of photons if they
// spread evenly over a sphere around the scene, and a few pixels. Both scale with the scene.
float initial_radius(const Parameters& parameters, float scene_radius, std::size_t light_paths, float pixel_footprint,
                     double target_pixels = usual_target_pixels);

// Radius of iteration i (from 0) in the schedule r_{i+1}^d = r_i^d (i + alpha) / (i + 1), i from 1
// [Knaus and Zwicker 2011, eq. 20], closed by the gamma function so that any iteration can be asked for.
double scheduled_radius(double first_radius, double alpha, int dimensions, std::uint64_t iteration);

} // namespace sundog
