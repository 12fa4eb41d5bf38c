// BSDFs of a scene file.
#pragma once

#include "import/object_reader.h"
#include "scene/scene.h"

#include <map>

namespace sundog
{

// Appends to a scene's list of BSDFs; an object that is used twice is imported once.
class BsdfImporter
{
public:
    BsdfImporter(const SceneIndex& index, std::vector<BsdfDescription>& bsdfs) : index_(index), bsdfs_(bsdfs) {}

    // Each returns an index into the list. Throws SceneError for plugins and values that are not supported.
    uint import(const XmlElement& element);
    uint add_diffuse(const std::string& id, const SourceLocation& where, Vec3 reflectance);

private:
    uint add(const XmlElement& element, decltype(BsdfDescription::model) model);
    decltype(BsdfDescription::model) read(ObjectReader& reader);
    DielectricBsdf read_dielectric(ObjectReader& reader, bool thin);
    ConductorBsdf read_conductor(ObjectReader& reader);
    TwoSidedBsdf read_two_sided(ObjectReader& reader);

    const SceneIndex& index_;
    std::vector<BsdfDescription>& bsdfs_;
    std::map<const XmlElement*, uint> imported_;
};

} // namespace sundog
