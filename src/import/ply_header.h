// The header of a PLY file: which elements follow, with which properties.
#pragma once

#include "base/errors.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sundog
{

enum class PlyFormat { text, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyRole { other, coordinate, indices }; // x y z nx ny nz of vertices; the list of vertices of a face

std::size_t size_of(PlyType type); // bytes

struct PlyProperty {
    PlyType type = PlyType::float32;
    std::optional<PlyType> count_type; // of a list
    std::string name;
    PlyRole role = PlyRole::other;
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::text;
    std::vector<PlyElement> elements;
    std::size_t vertices = 0;
    std::size_t size = 0; // bytes
    int lines = 0;
};

// Throws SceneError, at the line within `file`, for a malformed header, and when there are no vertices with x, y, z or no
// faces.
PlyHeader read_ply_header(const SourceLocation& file, std::string_view content);

} // namespace sundog
