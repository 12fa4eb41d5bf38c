// What `sundog info` says of a scene.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <string>

namespace sundog {

struct SceneSummary {
    std::string file;
    std::map<std::string, std::size_t> shapes; // number by kind: "mesh", "sphere", "disk"
    std::map<std::string, std::size_t> bsdfs; // "diffuse", "dielectric", ...
    std::map<std::string, std::size_t> emitters; // "area", "point", ...
    std::size_t triangles = 0; // stored: those of groups once
    std::size_t triangles_with_copies = 0; // seen: those of groups once an instance
    std::size_t groups = 0;
    std::size_t instances = 0;
    Shutter shutter;
    bool camera_moves = false;
    std::size_t moving_instances = 0; // moving shapes included, each in a group of its own
    std::size_t lights = 0; // as they are sampled: one a primitive of an emissive shape
    Bounds bounds; // of what is seen at any time
    int width = 0; // pixels of the image (the crop)
    int height = 0;
    std::string filter;
    std::string method; // empty: the scene names none
    std::map<std::string, std::string> parameters; // as the scene gives them
    std::uint64_t scene_bytes = 0; // on the device: geometry, hierarchy, materials, lights
    std::uint64_t film_bytes = 0; // on the device; a method adds its own buffers
};

// Builds the acceleration structure, so that what cannot be rendered is found. Throws SceneError.
SceneSummary summarize(const Scene& scene);

} // namespace sundog
