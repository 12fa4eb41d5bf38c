// Which scene a render is of, as far as its pixels depend on it.
#pragma once

#include "scene/flat_scene.h"

#include <string>

namespace sundog {

// 32 hexadecimal digits over what light meets: all of the scene but its camera.
std::string light_fingerprint(const FlatScene& scene);

// 32 hexadecimal digits over all that the device is given: the same for a scene file that was moved, renamed or laid
// out in another way, another one for any change of geometry, material, light, camera, film size or filter.
std::string fingerprint(const FlatScene& scene, const Camera& camera, const PixelFilter& filter);

} // namespace sundog
