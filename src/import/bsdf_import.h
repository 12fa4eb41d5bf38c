// BSDFs of a scene file.
#pragma once

#include "import/texture_import.h"

#include <map>
#include <set>
#include <span>

namespace sundog
{

// Appends to a scene's list of BSDFs; an object that is used twice is imported once.
class BsdfImporter
{
public:
    BsdfImporter(const SceneIndex& index, TextureImporter& textures, std::vector<BsdfDescription>& bsdfs) : index_(index), textures_(textures), bsdfs_(bsdfs)
    {
    }

    // Each returns an index into the list. Throws SceneError for plugins and values that are not supported.
    uint import(const XmlElement& element);
    uint add_diffuse(const std::string& id, const SourceLocation& where, ColorSource reflectance);

private:
    using Model = decltype(BsdfDescription::model);

    uint add(const XmlElement& element, Model model);
    Model read(ObjectReader& reader);
    DielectricBsdf read_dielectric(ObjectReader& reader, bool thin);
    ConductorBsdf read_conductor(ObjectReader& reader);
    void read_conductor_index(ObjectReader& reader, ConductorBsdf& bsdf);
    PlasticBsdf read_plastic(ObjectReader& reader, bool rough);
    CoatingBsdf read_coating(ObjectReader& reader, bool rough);
    PhongBsdf read_phong(ObjectReader& reader);
    Roughness read_roughness(ObjectReader& reader);
    TwoSidedBsdf read_two_sided(ObjectReader& reader);
    MaskBsdf read_mask(ObjectReader& reader);
    BlendBsdf read_blend(ObjectReader& reader);
    struct WeightedBsdf {
        const XmlElement* bsdf; // nullptr: black
        double weight;
    };
    NormalMapBsdf read_normal_map(ObjectReader& reader);
    BumpMapBsdf read_bump_map(ObjectReader& reader);
    template <class Map> void read_relief(ObjectReader& reader, Map& map);
    Model read_mixture(ObjectReader& reader);
    uint blend_of(const SourceLocation& where, std::span<const WeightedBsdf> parts);
    ColorSource reflectance(ObjectReader& reader, std::string_view name, Vec3 fallback) { return textures_.color(reader, name, fallback, ColorRole::reflectance); }
    // Several BSDFs inside; throws SceneError unless there are between least and most.
    std::vector<uint> nested(ObjectReader& reader, std::size_t least, std::size_t most);
    uint nesting(uint bsdf) const; // levels of masks and blends in it

    const SceneIndex& index_;
    TextureImporter& textures_;
    std::vector<BsdfDescription>& bsdfs_;
    std::map<const XmlElement*, uint> imported_;
    std::set<const XmlElement*> being_read_;
};

} // namespace sundog
