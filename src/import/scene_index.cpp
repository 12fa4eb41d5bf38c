#include "import/scene_index.h"

#include <algorithm>
#include <array>

namespace sundog
{

namespace
{

constexpr int max_aliases = 64; // one after another

} // namespace

bool is_object_tag(std::string_view tag)
{
    constexpr std::array<std::string_view, 14> tags = {"scene", "sensor",  "film",    "rfilter", "sampler", "integrator", "shape",
                                                       "bsdf",  "emitter", "texture", "medium",  "phase",   "volume",     "subsurface"};
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

SceneIndex::SceneIndex(const XmlScene& scene, std::vector<Warning>& warnings, const LocalOrigins& origins, bool allow_missing)
    : scene_(scene), warnings_(warnings), origins_(origins), allow_missing_(allow_missing)
{
    std::set<std::string> referenced_ids;
    collect(scene.root, referenced_ids);
    for (const std::string& id : referenced_ids) referenced_.insert(find(id));
}

void SceneIndex::missing(const SourceLocation& where, const std::string& what, const std::string& details, const std::string& stand_in) const
{
    if (!allow_missing_) throw SceneError(where, what + " is not supported" + details + "; with --allow-missing " + stand_in);
    warn(where, what + " is not supported: " + stand_in, WarningKind::approximated);
}

void SceneIndex::collect(const XmlElement& element, std::set<std::string>& referenced_ids)
{
    for (const auto& child : element.children) {
        if (child.tag == "alias") {
            const std::string* as = child.attribute("as");
            if (!as || !child.attribute("id")) throw SceneError(child.where, "<alias> needs the attributes id and as");
            add(*as, child);
        } else if (const std::string* id = child.attribute("id"); id && is_object_tag(child.tag)) {
            add(*id, child);
        } else if (id && child.tag == "ref") {
            referenced_ids.insert(*id);
        }
        collect(child, referenced_ids);
    }
}

void SceneIndex::add(const std::string& id, const XmlElement& element)
{
    const auto [entry, added] = objects_.emplace(id, &element);
    if (added) return;
    std::string first = entry->second->where.prefix();
    first.resize(first.size() - 2); // without ": "
    throw SceneError(element.where, "the id '" + id + "' is taken already, at " + first);
}

const XmlElement* SceneIndex::find(const std::string& id) const
{
    const XmlElement* object = nullptr;
    const std::string* name = &id;
    for (int step = 0; step <= max_aliases; step++) {
        const auto found = objects_.find(*name);
        if (found == objects_.end()) return nullptr;
        object = found->second;
        if (object->tag != "alias") break;
        name = object->attribute("id");
    }
    return object;
}

const XmlElement& SceneIndex::resolve(const XmlElement& reference) const
{
    const std::string* id = reference.attribute("id");
    if (!id) throw SceneError(reference.where, "<ref> needs the attribute id");
    const XmlElement* object = find(*id);
    if (!object) throw SceneError(reference.where, "reference to unknown id '" + *id + "'");
    if (object->tag == "alias")
        throw SceneError(reference.where, "the aliases of '" + *id + "' refer to each other in a circle, or more than " +
                                              std::to_string(max_aliases) + " times");
    return *object;
}

std::filesystem::path SceneIndex::find_file(const std::string& name, const SourceLocation& where) const
{
    const std::filesystem::path path(name);
    std::vector<std::filesystem::path> candidates;
    if (path.is_absolute()) {
        candidates.push_back(path);
    } else {
        for (const auto& folder : scene_.resource_folders) candidates.push_back(folder / path);
        candidates.push_back(std::filesystem::path(scene_.file).parent_path() / path);
        candidates.push_back(std::filesystem::path(where.file).parent_path() / path);
    }
    std::string tried;
    for (const auto& candidate : candidates) {
        std::error_code failed;
        if (std::filesystem::is_regular_file(candidate, failed)) {
            files_.insert(candidate);
            return candidate;
        }
        const std::string entry = "'" + candidate.string() + "'";
        if (tried.find(entry) == std::string::npos) tried += (tried.empty() ? "" : ", ") + entry;
    }
    throw SceneError(where, "file '" + name + "' not found; tried " + tried);
}

} // namespace sundog
