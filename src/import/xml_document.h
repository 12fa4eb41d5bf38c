// A scene file as a tree of elements that know their lines: includes expanded, $parameters substituted.
// Nothing here knows what an element means.
#pragma once

#include "base/errors.h"
#include "base/warning.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sundog
{

struct XmlElement {
    std::string tag;
    SourceLocation where;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<XmlElement> children;

    // Null without the attribute.
    const std::string* attribute(std::string_view name) const;
    // Its "name" in snake_case ("" without one), so that toWorld and to_world are one parameter.
    std::string parameter_name() const;
};

struct XmlScene {
    XmlElement root; // <scene>
    std::string file;
    bool legacy = false;                                 // version 0.x: Mitsuba 0.6's defaults
    std::vector<std::filesystem::path> resource_folders; // of <path>, the latest first
    std::vector<std::filesystem::path> included;
};

// Reads a scene file and all that it includes. `defines` override <default>s.
// Throws SceneError with file and line for unreadable files, malformed XML, undefined parameters, cyclic and
// excessive includes; UsageError for a define that no file uses, naming those that exist.
XmlScene read_scene_xml(const std::filesystem::path& file, const std::map<std::string, std::string>& defines,
                        std::vector<Warning>& warnings);

// camelCase to snake_case: "intIOR" gives "int_ior".
std::string snake_case(std::string_view name);

} // namespace sundog
