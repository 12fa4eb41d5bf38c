// The header of a PLY file: which elements follow, with which properties.
#pragma once

#include "base/errors.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sundog
{

enum class PlyFormat { text, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type); // bytes

struct PlyProperty {
    PlyType type = PlyType::float32;
    std::optional<PlyType> count_type; // of a list
    std::string name;
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t scalar(std::string_view name) const;                            // index of the property, or none
    std::size_t find_list(std::initializer_list<std::string_view> names) const; // of the first with one of these names
};

struct PlyHeader {
    PlyFormat format = PlyFormat::text;
    std::vector<PlyElement> elements;
    std::size_t vertices = 0;
    std::size_t size = 0; // bytes
    int lines = 0;

    const PlyElement* find(std::string_view name) const; // nullptr without one
};

// Throws SceneError, at the line within `file`, for a malformed header, an element that is declared twice or without
// properties, and when there are no vertices with x, y, z or no faces.
PlyHeader read_ply_header(const SourceLocation& file, std::string_view content);

} // namespace sundog
