#include "methods/standard_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sundog {

namespace {

constexpr double unlimited = 1e15;
// Photons that a query should find in the first iteration.
constexpr double target_photons = 10.0;

} // namespace

ParameterSpec iterations_spec()
{
    return {"iterations", ParameterType::integer, "0", "", "Iterations to render when the command line asks for none; 0: the scene's sample count, or 64.", 0,
            unlimited, {}};
}

ParameterSpec max_depth_spec()
{
    return {"max_depth", ParameterType::integer, "-1", "edges",
            "Longest path from light to camera; 1 shows only lights, 2 direct light, -1 has no bound (as in Mitsuba).", -1, 1e6, {}};
}

ParameterSpec rr_depth_spec(int default_depth, const std::string& paths)
{
    return {"rr_depth", ParameterType::integer, std::to_string(default_depth), "edges", "Depth from which Russian roulette may end " + paths + ".", 1, 1e6, {}};
}

ParameterSpec rr_depth_of_paths_spec()
{
    return {"rr_depth", ParameterType::integer, "0", "edges",
            fmt::format("Depth from which Russian roulette may end paths; 0: that of path or bdpt, {} or {}.", rr_depth_of_paths, rr_depth_of_subpaths), 0, 1e6, {}};
}

ParameterSpec sampler_spec()
{
    return {"sampler", ParameterType::choice, "sobol", "",
            "Random numbers: Owen-scrambled Sobol points (Burley 2020) or independent ones (Philox, Salmon et al. 2011).", 0, 0, {"sobol", "independent"}};
}

ParameterSpec photons_spec()
{
    return {"photons", ParameterType::integer, "0", "light subpaths", "Light subpaths traced in each iteration; 0: one a pixel.", 0, 4e9, {}};
}

ParameterSpec radius_spec()
{
    return {"radius", ParameterType::real, "0", "scene units",
            "Radius of the first iteration's density estimate; 0: a few pixels, or less where light subpaths are many.", 0, unlimited, {}};
}

ParameterSpec alpha_spec()
{
    return {"alpha", ParameterType::real, "0.6666667", "",
            "How slowly the radius shrinks; 2/3 balances bias and variance on surfaces (Kaplanyan and Dachsbacher 2013), 1 keeps it.", 0.01, 1.0, {}};
}

ParameterSpec direct_spec()
{
    return {"direct", ParameterType::choice, "nee", "",
            "Light that reaches a surface straight from its source: by next-event estimation, or by photons as all other light.", 0, 0, {"nee", "photons"}};
}

ParameterSpec light_choice_spec()
{
    return {"light_choice", ParameterType::choice, "auto", "",
            "How next-event estimation chooses a light: for each point by a tree (Conty Estevez and Kulla 2018), or by power alone; auto: by a tree where "
            "lights are many.",
            0, 0, {"auto", "tree", "power"}};
}

ParameterSpec kernel_spec(const std::string& default_kernel)
{
    return {"kernel", ParameterType::choice, default_kernel, "", "Smoothing kernel of the density estimate (Silverman 1986).", 0, 0,
            {"uniform", "epanechnikov", "biweight", "triweight"}};
}

ParameterSpec filter_kernel_spec()
{
    ParameterSpec spec = kernel_spec();
    spec.choices.insert(spec.choices.end(), {"cone", "gaussian"});
    spec.description = "Smoothing kernel of the density estimate (Silverman 1986), or a filter of photon maps (Jensen 1996): the cone with c = 1.1, "
                       "or the Gaussian with the factor that keeps energy.";
    return spec;
}

ParameterSpec spectral_spec()
{
    return {"spectral", ParameterType::boolean, "false", "",
            "Compute with three wavelengths a pass (Wilkie et al. 2014) instead of red, green and blue; shows dispersion.", 0, 0, {}};
}

PathRules path_rules(const Parameters& parameters)
{
    const std::int64_t max_depth = parameters.integer("max_depth"), rr_depth = parameters.integer("rr_depth");
    const int usual_rr_depth = parameters.has("paths") && parameters.text("paths") == "bdpt" ? rr_depth_of_subpaths : rr_depth_of_paths;
    return {max_depth < 0 ? UNBOUNDED_DEPTH : static_cast<uint>(max_depth), static_cast<uint>(rr_depth > 0 ? rr_depth : usual_rr_depth)};
}

SamplerKind sampler_kind(const Parameters& parameters)
{
    return parameters.text("sampler") == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
}

LightSelection light_selection(const Parameters& parameters)
{
    if (!parameters.has("light_choice")) return LightSelection::power;
    const std::string& choice = parameters.text("light_choice");
    if (choice != "auto" && parameters.has("direct") && parameters.text("direct") == "photons")
        parameters.refuse("light_choice", "light_choice=" + choice +
                                              " is for next-event estimation, which direct=photons leaves out: "
                                              "leave one of them at its default (direct=nee, light_choice=auto)");
    if (parameters.has("connections") && parameters.text("connections") == "none") {
        if (choice != "auto")
            parameters.refuse("light_choice", "light_choice=" + choice + " is for next-event estimation, which connections=none leaves out: "
                                              "leave light_choice at its default (auto)");
        return LightSelection::power;
    }
    return choice == "tree" ? LightSelection::tree : choice == "power" ? LightSelection::power : LightSelection::automatic;
}

bool is_spectral(const Parameters& parameters)
{
    return parameters.has("spectral") && parameters.boolean("spectral");
}

int density_kernel(const Parameters& parameters)
{
    const std::vector<std::string> names = filter_kernel_spec().choices; // in the order of DENSITY_KERNEL
    for (std::size_t n = 0; n < names.size(); n++)
        if (names[n] == parameters.text("kernel")) return static_cast<int>(n);
    return 0;
}

std::size_t light_path_count(const Parameters& parameters, std::size_t pixels)
{
    const std::int64_t photons = parameters.integer("photons");
    return photons > 0 ? static_cast<std::size_t>(photons) : pixels;
}

float pixel_footprint(const Camera& camera, const Bounds& scene)
{
    const float width = 2.0f * camera.half_width / static_cast<float>(camera.film_width);
    // An orthographic camera sees all distances alike; its pixels need not be square.
    if (camera.kind == CAMERA_ORTHOGRAPHIC) return std::sqrt(width * 2.0f * camera.half_height / static_cast<float>(camera.film_height));
    // A camera in the middle of its scene sees walls about a radius away.
    const float distance = std::max(length(scene.center() - camera.position), 0.5f * scene.radius());
    return distance * width;
}

double given_radius(const Parameters& parameters, const std::string& name, float scene_radius)
{
    constexpr double resolution = 1e-7, smallest = 1e-15; // of coordinates; whose square is a normal number, also after shrinking
    const double radius = parameters.real(name), least = std::max(resolution * static_cast<double>(scene_radius), smallest);
    if (radius > 0.0 && radius < least)
        parameters.refuse(name, fmt::format("{}={:g} is less than 32-bit coordinates of this scene can tell apart: give at least {:.1g}, or 0 for an "
                                            "automatic radius",
                                            name, radius, least));
    return radius;
}

float initial_radius(const Parameters& parameters, float scene_radius, std::size_t light_paths, float pixel_footprint, double target_pixels)
{
    const double radius = given_radius(parameters, "radius", scene_radius);
    if (radius > 0.0) return static_cast<float>(radius);
    // N photons on a sphere of radius R: N r^2 / (4 R^2) of them lie within r.
    const double by_density = 2.0 * static_cast<double>(scene_radius) * std::sqrt(target_photons / static_cast<double>(light_paths));
    return static_cast<float>(std::min(by_density, target_pixels * static_cast<double>(pixel_footprint)));
}

double scheduled_radius(double first_radius, double alpha, int dimensions, std::uint64_t iteration)
{
    // prod_{i=1}^{n} (i + alpha) / (i + 1) = Gamma(n + 1 + alpha) / (Gamma(1 + alpha) Gamma(n + 2))
    const double n = static_cast<double>(iteration);
    const double log_ratio = std::lgamma(n + 1.0 + alpha) - std::lgamma(1.0 + alpha) - std::lgamma(n + 2.0);
    return first_radius * std::exp(log_ratio / dimensions);
}

} // namespace sundog
