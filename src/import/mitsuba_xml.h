// Scenes in Mitsuba's XML: the 3.x schema, and 0.6's names (camelCase, <lookAt>, <srgb>, ...) beside it.
//
// What is supported is listed in README.md and docs/mitsuba.md. Any object may stand at the level of the scene for others to
// refer to. The integrator is kept as text for the method that it names.
//
// Files: a scene may refer to any file by an absolute path or one with .. in it, as users' scenes do; a file's content is
// never shown but as the word that a message quotes. Only regular files are opened, of bounded size, and neither cyclic
// or nested includes nor parameters within parameters can exhaust the memory; XML entities beyond the five predefined
// ones are left as they are.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sundog
{

struct LoadOptions {
    std::map<std::string, std::string> defines; // -D NAME=VALUE: override the scene's <default>s
    bool allow_missing = false; // plain stand-ins for what is not supported, with a warning each
    std::uint64_t texture_bytes = std::uint64_t{1} << 30; // budget; larger bitmaps are scaled down
};

struct LoadedScene {
    Scene scene;
    std::vector<std::filesystem::path> files; // that the scene names: included scenes, meshes, images, spectra
    std::vector<Warning> warnings; // sensor, shapes, lights, integrator: what was ignored, clamped or dropped
};

// Throws SceneError, with file and line, for a file that cannot be read (meshes and includes too), is malformed, asks
// for a plugin or parameter that would change the image and is not supported, or describes nothing that can be
// rendered (no sensor, no light, values out of range). Throws UsageError for a define of an unknown name.
LoadedScene load_scene(const std::filesystem::path& file, const LoadOptions& options);

} // namespace sundog
