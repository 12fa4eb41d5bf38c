// The principled BSDF of a scene file.
#pragma once

#include "import/texture_import.h"

#include <array>

namespace sundog
{

// A parameter between 0 and 1, or a texture of such, and its name in a file.
struct PrincipledNumber {
    const char* name;
    NumberSource PrincipledBsdf::*member;
};

// In the order in which textures are numbered when a scene is read.
inline constexpr std::array<PrincipledNumber, 10> principled_numbers = {{{"roughness", &PrincipledBsdf::roughness},
                                                                         {"anisotropic", &PrincipledBsdf::anisotropic},
                                                                         {"metallic", &PrincipledBsdf::metallic},
                                                                         {"spec_trans", &PrincipledBsdf::spec_trans},
                                                                         {"spec_tint", &PrincipledBsdf::spec_tint},
                                                                         {"sheen", &PrincipledBsdf::sheen},
                                                                         {"sheen_tint", &PrincipledBsdf::sheen_tint},
                                                                         {"flatness", &PrincipledBsdf::flatness},
                                                                         {"clearcoat", &PrincipledBsdf::clearcoat},
                                                                         {"clearcoat_gloss", &PrincipledBsdf::clearcoat_gloss}}};

// Throws SceneError for values that are not supported.
PrincipledBsdf read_principled(ObjectReader& reader, TextureImporter& textures);

} // namespace sundog
