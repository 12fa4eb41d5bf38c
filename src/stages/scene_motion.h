// What moves while the shutter is open (docs/motion.md).
#pragma once

#include "stages/device_scene.h"

namespace sundog
{

// Gives each pass one time, at which its camera rays and its light paths are traced alike. Does nothing where nothing moves.
class SceneMotion
{
public:
    // Keeps references to all three; camera: of the scene's sensor and film.
    SceneMotion(DeviceScene& device_scene, const Scene& scene, Camera& camera, std::uint64_t seed)
        : device_scene_(device_scene), scene_(scene), camera_(camera), seed_(seed), moves_(scene.moves())
    {
    }

    // Before a pass: moves the camera and the device's instances to where they are at its time.
    void begin_pass(std::uint64_t pass);

private:
    DeviceScene& device_scene_;
    const Scene& scene_;
    Camera& camera_;
    std::uint64_t seed_;
    bool moves_;
};

} // namespace sundog
