// Properties of PLY elements beyond positions, normals and texture coordinates, as mesh attributes.
#pragma once

#include "import/ply_header.h"

#include <array>

namespace sundog
{

struct PlyAttribute {
    std::string name;
    std::array<std::size_t, 3> properties; // indices into PlyElement::properties; a number is three times the same
    bool is_color = false;
};

struct PlyAttributes {
    std::vector<PlyAttribute> list;
    std::vector<std::string> unused; // names of properties
};

// Names as in Mitsuba 3, with `prefix` "vertex_" or "face_": r g b, red green blue (and 0.6's diffuse_red ...) make
// PREFIXcolor; consecutive NAME_x NAME_y NAME_z, NAME_0 1 2, NAME_1 2 3 or one of them alone make PREFIXNAME; NAME_r g b
// make PREFIXNAME_color. `taken` lists properties with a meaning of their own.
PlyAttributes find_attributes(const PlyElement& element, const std::string& prefix, const std::vector<std::size_t>& taken);

} // namespace sundog
