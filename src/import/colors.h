// Colours of a scene file, in any of their spellings, as linear sRGB.
#pragma once

#include "import/scene_index.h"
#include "math/vec3.h"

namespace sundog
{

// What a colour means decides how a spectrum is reduced and which values are allowed.
enum class ColorRole {
    reflectance, // [0, 1]; outside is clamped with a warning
    emission,    // >= 0
    index,       // of refraction, >= 0
};

bool is_color_tag(std::string_view tag);

// Reads <rgb>, <srgb>, <spectrum>, <blackbody>, <float> and <integer>. Throws SceneError for malformed or
// negative values and for textures.
Vec3 read_color(const XmlElement& element, const SceneIndex& index, ColorRole role);

} // namespace sundog
