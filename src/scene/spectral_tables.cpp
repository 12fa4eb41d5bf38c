// Made by scripts/make_spectral_basis. Values at spectral_nodes wavelengths, linear between them.
#include "scene/spectral_basis.h"

namespace sundog {

// clang-format off
// Reflectance of linear sRGB (1, 0, 0).
const double red_table[spectral_nodes] = {
    0.0284592, 0.0284582, 0.0284526, 0.0284328, 0.028359, 0.0280627, 0.0270468, 0.0243425,
    0.0201243, 0.0184877, 0.0291785, 0.0119544, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0.0150532, 0.2061147, 0.4776173,
    0.7396236, 0.9248276, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1,
};
// Reflectance of linear sRGB (0, 1, 0); what is left of 1 is that of (0, 0, 1).
const double green_table[spectral_nodes] = {
    0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0.1092995, 0.2947983, 0.5079012, 0.7163209, 0.8879755,
    0.9912083, 1, 1, 1, 1, 0.9379696, 0.7418484, 0.4880384,
    0.2480148, 0.0751724, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0,
};
// clang-format on

} // namespace sundog
