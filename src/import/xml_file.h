// One XML file, parsed, with the line of each node.
#pragma once

#include "import/text_file.h"

#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace sundog
{

class XmlFile
{
public:
    // `wanted_at`: the place that asks for the file; an unreadable file is reported there.
    // Throws SceneError: unreadable; malformed (with the line in the file); no or several root elements.
    XmlFile(const std::filesystem::path& file, const SourceLocation& wanted_at, FileKind kind = FileKind::regular);

    pugi::xml_node root() const { return document_.document_element(); }
    std::size_t size() const { return size_; } // bytes
    SourceLocation where(pugi::xml_node node) const;

private:
    int line_of(std::ptrdiff_t offset) const;

    std::string name_;
    std::size_t size_ = 0;
    pugi::xml_document document_;
    std::vector<std::ptrdiff_t> line_starts_;
};

} // namespace sundog
