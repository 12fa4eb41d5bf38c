#include "import/bsdf_writer.h"

#include "import/principled_import.h"

namespace sundog
{

BsdfWriter::BsdfWriter(const Scene& scene, WrittenIds& ids, const TextureWriter& textures) : scene_(scene), textures_(textures)
{
    for (std::size_t i = 0; i < scene.bsdfs.size(); i++) ids_.push_back(ids.add(scene.bsdfs[i].id, "bsdf", i));
}

void BsdfWriter::write_all(ObjectWriter root) const
{
    for (std::size_t i = 0; i < scene_.bsdfs.size(); i++)
        std::visit([&](const auto& model) { write(root, ids_[i], model); }, scene_.bsdfs[i].model);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const DiffuseBsdf& bsdf) const
{
    textures_.color(root.object("bsdf", "diffuse", "", id), "reflectance", bsdf.reflectance);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const DielectricBsdf& bsdf) const
{
    const char* type = bsdf.thin ? "thindielectric" : bsdf.roughness ? "roughdielectric" : "dielectric";
    ObjectWriter object = root.object("bsdf", type, "", id);
    const auto dispersion = bsdf.dispersion ? name_of(*bsdf.dispersion) : std::nullopt;
    if (dispersion)
        object.text("dispersion", *dispersion);
    else
        object.number("int_ior", bsdf.int_ior);
    object.number("ext_ior", bsdf.ext_ior);
    textures_.color(object, "specular_reflectance", bsdf.specular_reflectance);
    textures_.color(object, "specular_transmittance", bsdf.specular_transmittance);
    write_roughness(object, bsdf.roughness);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const ConductorBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", bsdf.roughness ? "roughconductor" : "conductor", "", id);
    object.color("eta", bsdf.eta);
    object.color("k", bsdf.k);
    textures_.color(object, "specular_reflectance", bsdf.specular_reflectance);
    write_roughness(object, bsdf.roughness);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const PlasticBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", bsdf.roughness ? "roughplastic" : "plastic", "", id);
    object.number("int_ior", bsdf.int_ior);
    object.number("ext_ior", bsdf.ext_ior);
    textures_.color(object, "diffuse_reflectance", bsdf.diffuse_reflectance);
    textures_.color(object, "specular_reflectance", bsdf.specular_reflectance);
    object.boolean("nonlinear", bsdf.nonlinear);
    write_roughness(object, bsdf.roughness);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const PrincipledBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "principled", "", id);
    textures_.color(object, "base_color", bsdf.base_color);
    object.number("eta", bsdf.eta);
    for (const PrincipledNumber& number : principled_numbers) textures_.number(object, number.name, bsdf.*number.member);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const PhongBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "phong", "", id);
    textures_.color(object, "diffuse_reflectance", bsdf.diffuse_reflectance);
    textures_.color(object, "specular_reflectance", bsdf.specular_reflectance);
    textures_.number(object, "exponent", bsdf.exponent);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const CoatingBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", bsdf.roughness ? "roughcoating" : "coating", "", id);
    object.number("int_ior", bsdf.int_ior);
    object.number("ext_ior", bsdf.ext_ior);
    object.number("thickness", bsdf.thickness);
    textures_.color(object, "sigma_a", bsdf.sigma_a);
    textures_.color(object, "specular_reflectance", bsdf.specular_reflectance);
    write_roughness(object, bsdf.roughness);
    object.reference(ids_[bsdf.nested]);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const NormalMapBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "normalmap", "", id);
    textures_.color(object, "normalmap", bsdf.normals);
    object.boolean("flip_invalid_normals", bsdf.flip_invalid);
    object.boolean("use_shadowing_function", bsdf.shadowing);
    object.reference(ids_[bsdf.nested]);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const BumpMapBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "bumpmap", "", id);
    // The factor beside the texture, for unlike a texture's it may be negative.
    const float unscaled = luminance({1, 1, 1});
    object.number("scale", bsdf.heights.value / unscaled);
    textures_.number(object, "arbitrary", NumberSource(unscaled, bsdf.heights.texture.value()));
    object.boolean("flip_invalid_normals", bsdf.flip_invalid);
    object.boolean("use_shadowing_function", bsdf.shadowing);
    object.reference(ids_[bsdf.nested]);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const NullBsdf&) const
{
    root.object("bsdf", "null", "", id);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const TwoSidedBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "twosided", "", id);
    object.reference(ids_[bsdf.front]);
    if (bsdf.back != bsdf.front) object.reference(ids_[bsdf.back]);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const MaskBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "mask", "", id);
    textures_.number(object, "opacity", bsdf.opacity);
    object.reference(ids_[bsdf.nested]);
}

void BsdfWriter::write(ObjectWriter root, const std::string& id, const BlendBsdf& bsdf) const
{
    ObjectWriter object = root.object("bsdf", "blendbsdf", "", id);
    textures_.number(object, "weight", bsdf.weight);
    for (uint nested : bsdf.nested) object.reference(ids_[nested]);
}

void BsdfWriter::write_roughness(ObjectWriter object, const std::optional<Roughness>& roughness) const
{
    if (!roughness) return;
    const NumberSource &u = roughness->alpha_u, &v = roughness->alpha_v;
    object.text("distribution", roughness->beckmann ? "beckmann" : "ggx");
    if (u.value == v.value && u.texture == v.texture) {
        textures_.number(object, "alpha", u);
    } else {
        textures_.number(object, "alpha_u", u);
        textures_.number(object, "alpha_v", v);
    }
}

} // namespace sundog
