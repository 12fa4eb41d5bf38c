// Scenes as Mitsuba 3 XML, resolved: what load_scene() made of a file, with all of its defaults, parameters, includes
// and aliases, and with transforms baked in. load_scene() reads it as the same scene: all that the device is given
// (scene/fingerprint.h), method, parameters, sample count and seed are the same bit for bit.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace sundog
{

// The XML. Meshes and images are written to the folder `files`, which is made when there are any, and the XML refers to
// them relative to the folder that `files` is in: a scene file there can be moved together with it. Throws FileError
// when they cannot be written, and SceneError for what XML cannot express (a $ in a name).
std::string write_scene(const Scene& scene, const std::filesystem::path& files);

} // namespace sundog
