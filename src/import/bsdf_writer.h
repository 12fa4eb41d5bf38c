// BSDFs of a scene file that is written.
#pragma once

#include "import/texture_writer.h"

namespace sundog
{

class BsdfWriter
{
public:
    BsdfWriter(const Scene& scene, WrittenIds& ids, const TextureWriter& textures);

    // Declares all BSDFs in `root`, for shapes to refer to by id().
    void write_all(ObjectWriter root) const;
    const std::string& id(uint bsdf) const { return ids_[bsdf]; }

private:
    // One of each alternative of BsdfDescription::model.
    void write(ObjectWriter root, const std::string& id, const DiffuseBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const DielectricBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const ConductorBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const PlasticBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const PrincipledBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const PhongBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const CoatingBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const NormalMapBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const BumpMapBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const NullBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const TwoSidedBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const MaskBsdf& bsdf) const;
    void write(ObjectWriter root, const std::string& id, const BlendBsdf& bsdf) const;
    void write_roughness(ObjectWriter object, const std::optional<Roughness>& roughness) const;

    const Scene& scene_;
    const TextureWriter& textures_;
    std::vector<std::string> ids_; // of scene_.bsdfs
};

} // namespace sundog
