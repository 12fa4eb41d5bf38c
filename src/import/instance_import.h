// Shape groups and their instances in a scene file.
#pragma once

#include "import/bsdf_import.h"

#include <map>

namespace sundog
{

// A group is imported once, for its first instance; one without instances is not seen and not imported.
class InstanceImporter
{
public:
    InstanceImporter(const SceneIndex& index, BsdfImporter& bsdfs, TextureImporter& textures, Scene& scene)
        : index_(index), bsdfs_(bsdfs), textures_(textures), scene_(scene)
    {
    }

    // Imports the shape if it is an instance, and notes it if it is a group; false for other shapes. Throws SceneError for
    // an instance that names no group, and for a group that is empty or holds a light, an instance or a group.
    bool import(const XmlElement& element);

    // Warns of groups that have no instance.
    void finish() const;

private:
    void import_instance(const XmlElement& element);
    std::optional<uint> import_group(const XmlElement& element); // nothing where all of it is left out
    void import_member(const NestedObject& member, uint group);

    const SceneIndex& index_;
    BsdfImporter& bsdfs_;
    TextureImporter& textures_;
    Scene& scene_;
    std::vector<const XmlElement*> declared_;
    std::map<const XmlElement*, std::optional<uint>> imported_;
};

} // namespace sundog
