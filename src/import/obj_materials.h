// The material libraries of OBJ files.
#pragma once

#include "import/obj.h"

#include <string_view>

namespace sundog
{

// Reads the libraries of one mtllib line, which are beside the OBJ file, and appends their materials and warnings.
void append_materials(const std::filesystem::path& obj_file, std::string_view names, ObjFile& result);

} // namespace sundog
