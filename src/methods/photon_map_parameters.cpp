#include "methods/photon_map_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sundog
{

namespace
{

// Photons that a lookup of automatic radius should find, and pixels that a caustic's radius may span.
constexpr double usual_photons = 50.0;
constexpr double caustic_pixels = 4.0;
// How far k photons are searched, as a multiple of the radius that would hold them if light were even.
constexpr double search_limit = 2.0;

// N photons on a sphere of the scene's radius R: N r^2 / (4 R^2) of them lie within r. largest: of automatic radii.
PhotonLookup make_lookup(const Parameters& parameters, const std::string& radius, float scene_radius, std::uint64_t light_paths,
                         double largest)
{
    PhotonLookup lookup;
    if (parameters.text("lookup") == "nearest") lookup.nearest = static_cast<uint>(parameters.integer("nearest"));
    const double photons = lookup.nearest > 0 ? lookup.nearest : usual_photons;
    const double by_density = 2.0 * static_cast<double>(scene_radius) * std::sqrt(photons / static_cast<double>(light_paths));
    const double automatic = lookup.nearest > 0 ? search_limit * by_density : std::min(by_density, largest);
    const double given = given_radius(parameters, radius, scene_radius);
    lookup.radius = static_cast<float>(given > 0.0 ? given : automatic);
    lookup.usual_radius = std::min(lookup.radius, static_cast<float>(by_density));
    lookup.density_kernel = density_kernel(parameters);
    return lookup;
}

ParameterSpec file_spec(const std::string& name, const std::string& description)
{
    return {name, ParameterType::file, "", "", description, 0, 0, {}};
}

} // namespace

ParameterSpec maps_spec()
{
    return {
        "maps",
        ParameterType::choice,
        "one",
        "",
        "Trace photons once, before the first iteration (one; Jensen 1996), or others in each (fresh): their noise falls with iterations "
        "then, their blur stays, and errors can be estimated.",
        0,
        0,
        {"one", "fresh"}};
}

bool has_fresh_maps(const Parameters& parameters)
{
    return parameters.text("maps") == "fresh";
}

ParameterSpec global_photons_spec()
{
    ParameterSpec spec = photons_spec();
    spec.description = "Light subpaths of the global map; 0: one a pixel.";
    return spec;
}

ParameterSpec global_radius_spec()
{
    ParameterSpec spec = radius_spec();
    spec.description =
        "Radius of lookups in the global map, the largest one for nearest photons; 0: where light is even it finds 50 photons, or is twice "
        "what k of them need.";
    return spec;
}

ParameterSpec caustic_photons_spec()
{
    ParameterSpec spec = photons_spec();
    spec.name = "caustic_photons";
    spec.description = "Light subpaths of the caustic map; 0: four times those of the global map.";
    return spec;
}

ParameterSpec caustic_radius_spec()
{
    ParameterSpec spec = radius_spec();
    spec.name = "caustic_radius";
    spec.description = "Radius of lookups in the caustic map; 0: as `radius`, but a few pixels at most.";
    return spec;
}

ParameterSpec lookup_spec()
{
    return {"lookup",
            ParameterType::choice,
            "radius",
            "",
            "What a lookup takes: all photons within the radius, or the nearest (Jensen 1996).",
            0,
            0,
            {"radius", "nearest"}};
}

ParameterSpec nearest_spec()
{
    return {"nearest",
            ParameterType::integer,
            "50",
            "photons",
            "k of lookup=nearest: the k - 1 photons that are nearer than the k-th count, over the area within it.",
            2,
            512,
            {}};
}

ParameterSpec relaxation_spec()
{
    return {"relaxation",
            ParameterType::integer,
            "0",
            "sweeps",
            "Move photons apart until they lie evenly, so that few suffice for a lookup; about 10 (Spencer and Jones 2009).",
            0,
            1000,
            {}};
}

ParameterSpec progressive_relaxation_spec()
{
    return {"relaxation_progressive",
            ParameterType::boolean,
            "false",
            "",
            "Trace new photons in each iteration, give their flux to those of the first, and move these until they have equal flux "
            "(Spencer and Jones 2013); needs unbounded max_depth.",
            0,
            0,
            {}};
}

ParameterSpec final_gather_spec()
{
    return {"final_gather",
            ParameterType::boolean,
            "true",
            "",
            "Look light that diffuse surfaces have scattered up where a ray, one an iteration, gathers it; else at once (Jensen 1996).",
            0,
            0,
            {}};
}

ParameterSpec precompute_spec()
{
    return {"precompute",
            ParameterType::boolean,
            "false",
            "",
            "Let gather rays read irradiance that was computed ahead at every fourth photon (Christensen 1999); needs unbounded max_depth.",
            0,
            0,
            {}};
}

ParameterSpec save_map_spec()
{
    return file_spec("save_map", "File to save the photon maps to; none: they are not saved.");
}

ParameterSpec load_map_spec()
{
    return file_spec("load_map", "File to take the photon maps from, saved by a render of the same scene; none: they are traced.");
}

PhotonLookup global_lookup(const RenderContext& context, const Parameters& parameters, std::uint64_t light_paths)
{
    return make_lookup(parameters, "radius", context.scene.radius(), light_paths, std::numeric_limits<double>::infinity());
}

PhotonLookup caustic_lookup(const RenderContext& context, const Parameters& parameters, std::uint64_t light_paths)
{
    const double footprint = static_cast<double>(pixel_footprint(context.camera, context.scene.bounds()));
    return make_lookup(parameters, "caustic_radius", context.scene.radius(), light_paths, caustic_pixels * footprint);
}

} // namespace sundog
