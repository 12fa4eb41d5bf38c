// What the parts of an importer share: objects by id, files by name, where places are counted from,
// and the list of warnings.
#pragma once

#include "base/warning.h"
#include "import/local_origin.h"
#include "import/xml_document.h"

#include <map>

namespace sundog
{

// Tags that declare objects (plugins) rather than values.
bool is_object_tag(std::string_view tag);

class SceneIndex
{
public:
    // Keeps references to all. Throws SceneError for an id that is given twice.
    SceneIndex(const XmlScene& scene, std::vector<Warning>& warnings, const LocalOrigins& origins);

    // The object that a <ref> means, through any <alias>. Throws SceneError for unknown ids.
    const XmlElement& resolve(const XmlElement& reference) const;

    // The path of a file that the scene names: absolute, in a <path> folder, beside the scene, or beside the
    // including file. Throws SceneError naming the paths tried.
    std::filesystem::path find_file(const std::string& name, const SourceLocation& where) const;

    void warn(const SourceLocation& where, const std::string& message, WarningKind kind = WarningKind::note) const
    {
        warnings_.emplace_back(where.prefix() + message, kind);
    }
    bool legacy() const { return scene_.legacy; }
    const LocalOrigins& origins() const { return origins_; }

private:
    void collect(const XmlElement& element);
    void add(const std::string& id, const XmlElement& element);

    const XmlScene& scene_;
    std::vector<Warning>& warnings_;
    const LocalOrigins& origins_;
    std::map<std::string, const XmlElement*, std::less<>> objects_; // an <alias> stands for itself
};

} // namespace sundog
