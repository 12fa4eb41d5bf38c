// Photon maps in a file: traced once, used by many renders of a scene.
#pragma once

#include "math/bounds.h"
#include "methods/traced_photons.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sundog
{

// What photons depend on, as far as a map made for something else would be wrong.
struct PhotonMapOrigin {
    std::string scene;                                           // light_fingerprint
    std::vector<std::pair<std::string, std::string>> parameters; // of the method; one that is empty was not asked for, and agrees with all
};

// Whole or not at all, in the layout of base/checkpoint_file.h: a section "photon maps" (JSON), and one a map. Throws FileError.
void save_photon_maps(const std::filesystem::path& file, const PhotonMapOrigin& origin, const MapPhotons& maps);

// Throws FileError, saying what is wrong and what to do: no such file, damaged or cut off, of another scene or another version
// of sundog, made with other parameters, or with photons that no scene of these bounds can have. No rays were traced for what is returned.
MapPhotons load_photon_maps(const std::filesystem::path& file, const PhotonMapOrigin& origin, const Bounds& bounds);

} // namespace sundog
