#include "methods/photon_map_conflicts.h"

#include "methods/photon_map_parameters.h"

#include <fmt/format.h>

namespace sundog
{

namespace
{

// Refuses the parameter `name`, set as `first` says.
[[noreturn]] void refuse_pair(const Parameters& parameters, const std::string& name, const std::string& first, const std::string& second,
                              const std::string& why)
{
    parameters.refuse(name, fmt::format("photonmapper cannot take both {} and {}: {}", first, second, why));
}

// Maps in files are those of all iterations.
void check_files(const Parameters& parameters)
{
    const bool saves = !parameters.text("save_map").empty(), loads = !parameters.text("load_map").empty();
    if (saves && loads) refuse_pair(parameters, "save_map", "save_map", "load_map", "maps that are loaded are in a file already");
    if (saves || loads) {
        const std::string file = saves ? "save_map" : "load_map";
        if (is_spectral(parameters))
            refuse_pair(parameters, file, "spectral=true", file, "each iteration has photon maps of its own, at other wavelengths");
        if (has_fresh_maps(parameters))
            refuse_pair(parameters, file, "maps=fresh", file, "each iteration has photon maps of its own; use -p maps=one");
    }
    if (parameters.integer("importons") > 0 && loads)
        refuse_pair(parameters, "importons", "importons", "load_map", "importons choose among photons that are traced");
}

// Sums of light of all depths know no bound.
void check_unbounded(const Parameters& parameters, const std::string& name)
{
    if (path_rules(parameters).max_depth == UNBOUNDED_DEPTH) return;
    parameters.refuse(name,
                      fmt::format("photonmapper's {}=true sums light of all depths: it cannot go with max_depth={}; use -p max_depth=-1",
                                  name, parameters.text("max_depth")));
}

void check_progressive_relaxation(const Parameters& parameters)
{
    const std::string name = "relaxation_progressive";
    if (!parameters.boolean(name)) return;
    const auto refuse = [&](const std::string& other, const std::string& why) {
        refuse_pair(parameters, name, name + "=true", other, why);
    };
    if (is_spectral(parameters)) refuse("spectral=true", "flux of other wavelengths does not add up");
    for (const char* file : {"save_map", "load_map"})
        if (!parameters.text(file).empty()) refuse(file, "each iteration changes the maps");
    if (has_fresh_maps(parameters))
        refuse("maps=fresh", "it gives the flux of each iteration's photons to those of the first; use -p maps=one");
    check_unbounded(parameters, name);
}

void check_precomputed_irradiance(const Parameters& parameters)
{
    if (!parameters.boolean("precompute")) return;
    if (!parameters.boolean("final_gather"))
        parameters.refuse("precompute", "photonmapper's precompute=true is for gather rays: it cannot go with final_gather=false");
    check_unbounded(parameters, "precompute");
}

// What moves light in ways of its own, by distances that go with the radius, has a bias that no Laplacian shows.
void check_errors(const Parameters& parameters)
{
    const auto refuse = [&](const std::string& name, const std::string& off, const std::string& what) {
        parameters.refuse(
            name, fmt::format("photonmapper knows no bias of {}: use -p {}={}, or leave out --errors, --error-image and --target-error",
                              what, name, off));
    };
    if (parameters.boolean("precompute"))
        refuse("precompute", "false", "irradiance that is read beside where it was computed (precompute=true)");
    if (parameters.integer("relaxation") > 0) refuse("relaxation", "0", "photons that were moved (relaxation)");
}

} // namespace

void refuse_conflicts_of_photon_maps(const Parameters& parameters, bool estimates_errors)
{
    check_files(parameters);
    check_progressive_relaxation(parameters);
    check_precomputed_irradiance(parameters);
    if (estimates_errors) check_errors(parameters);
}

} // namespace sundog
