// What the parts of an importer share: objects by id, files by name, where places are counted from,
// and the list of warnings.
#pragma once

#include "base/warning.h"
#include "import/local_origin.h"
#include "import/xml_document.h"

#include <map>
#include <set>

namespace sundog
{

// Tags that declare objects (plugins) rather than values.
bool is_object_tag(std::string_view tag);

class SceneIndex
{
public:
    // Keeps references to all. Throws SceneError for an id that is given twice.
    SceneIndex(const XmlScene& scene, std::vector<Warning>& warnings, const LocalOrigins& origins, bool allow_missing = false);

    // The object that a <ref> means, through any <alias>. Throws SceneError for unknown ids.
    const XmlElement& resolve(const XmlElement& reference) const;
    // Whether some <ref> in the scene means this object.
    bool is_referenced(const XmlElement& object) const { return referenced_.contains(&object); }

    // The path of a file that the scene names: absolute, in a <path> folder, beside the scene, or beside the
    // including file. Throws SceneError naming the paths tried.
    std::filesystem::path find_file(const std::string& name, const SourceLocation& where) const;
    // All that find_file() has found.
    const std::set<std::filesystem::path>& files() const { return files_; }

    void warn(const SourceLocation& where, const std::string& message, WarningKind kind = WarningKind::note) const
    {
        warnings_.emplace_back(where.prefix() + message, kind);
    }
    void warn(Warning warning) const { warnings_.push_back(std::move(warning)); }
    bool legacy() const { return scene_.legacy; }
    const LocalOrigins& origins() const { return origins_; }

    // `what` is not supported: a warning that says what stands in for it ("it is left out") where the user allows that, else
    // SceneError with the details (": use diffuse") as well.
    void missing(const SourceLocation& where, const std::string& what, const std::string& details, const std::string& stand_in) const;

private:
    void collect(const XmlElement& element, std::set<std::string>& referenced_ids);
    void add(const std::string& id, const XmlElement& element);
    // The object of an id, through any <alias>. Null for an unknown id; an <alias> where they go in a circle.
    const XmlElement* find(const std::string& id) const;

    const XmlScene& scene_;
    std::vector<Warning>& warnings_;
    const LocalOrigins& origins_;
    bool allow_missing_;
    std::map<std::string, const XmlElement*, std::less<>> objects_; // an <alias> stands for itself
    std::set<const XmlElement*> referenced_;
    mutable std::set<std::filesystem::path> files_;
};

} // namespace sundog
