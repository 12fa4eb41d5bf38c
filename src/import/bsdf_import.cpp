#include "import/bsdf_import.h"

#include "scene/materials.h"

#include <algorithm>

namespace sundog
{

namespace
{

constexpr const char* supported_bsdfs =
    "diffuse, dielectric, roughdielectric, thindielectric, conductor, roughconductor, mask, blendbsdf, twosided, null";
constexpr uint max_nesting = 6; // of masks and blends: the device has room for a few more
constexpr double max_alpha = 1.0;

bool transmits(const std::vector<BsdfDescription>& bsdfs, uint index)
{
    const auto& model = bsdfs[index].model;
    if (const auto* blend = std::get_if<BlendBsdf>(&model)) return transmits(bsdfs, blend->nested[0]) || transmits(bsdfs, blend->nested[1]);
    return std::holds_alternative<DielectricBsdf>(model) || std::holds_alternative<NullBsdf>(model) || std::holds_alternative<MaskBsdf>(model);
}

} // namespace

uint BsdfImporter::import(const XmlElement& element)
{
    if (const auto found = imported_.find(&element); found != imported_.end()) return found->second;
    if (!being_read_.insert(&element).second) throw SceneError(element.where, "this bsdf contains itself");
    ObjectReader reader(element, index_);
    auto model = read(reader);
    reader.finish();
    const uint index = add(element, std::move(model));
    if (nesting(index) > max_nesting) throw SceneError(element.where, "masks and blends inside one another more than six deep are not supported");
    imported_[&element] = index;
    return index;
}

uint BsdfImporter::add_diffuse(const std::string& id, const SourceLocation& where, Vec3 reflectance)
{
    bsdfs_.push_back({id, where, DiffuseBsdf{reflectance}});
    return static_cast<uint>(bsdfs_.size() - 1);
}

uint BsdfImporter::add(const XmlElement& element, Model model)
{
    const std::string* id = element.attribute("id");
    bsdfs_.push_back({id ? *id : "", element.where, std::move(model)});
    return static_cast<uint>(bsdfs_.size() - 1);
}

uint BsdfImporter::nesting(uint bsdf) const
{
    const auto& model = bsdfs_[bsdf].model;
    if (const auto* mask = std::get_if<MaskBsdf>(&model)) return 1 + nesting(mask->nested);
    if (const auto* blend = std::get_if<BlendBsdf>(&model)) return 1 + std::max(nesting(blend->nested[0]), nesting(blend->nested[1]));
    if (const auto* sides = std::get_if<TwoSidedBsdf>(&model)) return std::max(nesting(sides->front), nesting(sides->back));
    return 0;
}

BsdfImporter::Model BsdfImporter::read(ObjectReader& reader)
{
    const std::string type = reader.type();
    if (type == "diffuse") {
        const char* name = reader.has("diffuse_reflectance") ? "diffuse_reflectance" : "reflectance"; // 0.6 has both
        return DiffuseBsdf{reflectance(reader, name, {0.5f, 0.5f, 0.5f})};
    }
    if (type == "dielectric" || type == "thindielectric") return read_dielectric(reader, type == "thindielectric");
    if (type == "roughdielectric") {
        DielectricBsdf bsdf = read_dielectric(reader, false);
        bsdf.roughness = read_roughness(reader);
        return bsdf;
    }
    if (type == "conductor") return read_conductor(reader);
    if (type == "roughconductor") {
        ConductorBsdf bsdf = read_conductor(reader);
        bsdf.roughness = read_roughness(reader);
        return bsdf;
    }
    if (type == "null") return NullBsdf{};
    if (type == "mask") return read_mask(reader);
    if (type == "blendbsdf") return read_blend(reader);
    if (type == "twosided") return read_two_sided(reader);
    reader.unsupported(supported_bsdfs);
}

DielectricBsdf BsdfImporter::read_dielectric(ObjectReader& reader, bool thin)
{
    DielectricBsdf bsdf;
    bsdf.thin = thin;
    if (reader.has("dispersion")) {
        if (reader.has("int_ior")) throw SceneError(reader.where_of("int_ior"), "give a dielectric either int_ior or dispersion, not both");
        const std::string name = reader.text("dispersion", "");
        bsdf.dispersion = find_dispersion(name);
        if (!bsdf.dispersion)
            throw SceneError(reader.where_of("dispersion"), "unknown dispersive material '" + name + "'; known are " + dispersion_names());
        bsdf.int_ior = static_cast<float>(index_at(*bsdf.dispersion, sodium_d_line));
    } else {
        bsdf.int_ior = reader.ior("int_ior", "bk7");
    }
    bsdf.ext_ior = reader.ior("ext_ior", "air");
    bsdf.specular_reflectance = reflectance(reader, "specular_reflectance", {1, 1, 1});
    bsdf.specular_transmittance = reflectance(reader, "specular_transmittance", {1, 1, 1});
    return bsdf;
}

void BsdfImporter::read_conductor_index(ObjectReader& reader, ConductorBsdf& bsdf)
{
    if (reader.has("material") && (reader.has("eta") || reader.has("k")))
        throw SceneError(reader.where_of("material"), "give a conductor either material or eta and k, not both");
    if (reader.has("eta") || reader.has("k")) {
        bsdf.eta = reader.color("eta", {0, 0, 0}, ColorRole::index);
        bsdf.k = reader.color("k", {1, 1, 1}, ColorRole::index);
        return;
    }
    const std::string material = reader.text("material", index_.legacy() ? "Cu" : "none");
    const auto constants = find_conductor(material);
    if (!constants) throw SceneError(reader.where_of("material"), "unknown conductor material '" + material + "'; known are " + conductor_names());
    bsdf.eta = constants->eta;
    bsdf.k = constants->k;
}

ConductorBsdf BsdfImporter::read_conductor(ObjectReader& reader)
{
    ConductorBsdf bsdf;
    read_conductor_index(reader, bsdf);
    if (reader.has("ext_eta")) {
        const float exterior = reader.ior("ext_eta", "air");
        bsdf.eta = bsdf.eta / exterior;
        bsdf.k = bsdf.k / exterior;
    }
    bsdf.specular_reflectance = reflectance(reader, "specular_reflectance", {1, 1, 1});
    return bsdf;
}

Roughness BsdfImporter::read_roughness(ObjectReader& reader)
{
    Roughness roughness;
    const std::string distribution = reader.text("distribution", "beckmann");
    if (distribution != "beckmann" && distribution != "ggx")
        throw SceneError(reader.where_of("distribution"), "'distribution' must be beckmann or ggx, got '" + distribution + "'");
    roughness.beckmann = distribution == "beckmann";
    if (reader.has("alpha") && (reader.has("alpha_u") || reader.has("alpha_v")))
        throw SceneError(reader.where_of("alpha"), "give either alpha or alpha_u and alpha_v, not both");
    if (reader.has("alpha_u") || reader.has("alpha_v")) {
        roughness.alpha_u = textures_.number(reader, "alpha_u", 0.1, 0.0, max_alpha);
        roughness.alpha_v = textures_.number(reader, "alpha_v", 0.1, 0.0, max_alpha);
    } else {
        roughness.alpha_u = roughness.alpha_v = textures_.number(reader, "alpha", 0.1, 0.0, max_alpha);
    }
    reader.ignore("sample_visible", "visible normals are always sampled");
    return roughness;
}

std::vector<uint> BsdfImporter::nested(ObjectReader& reader, std::size_t least, std::size_t most)
{
    const auto inside = reader.nested("bsdf");
    if (inside.size() < least || inside.size() > most) {
        const std::string wanted = least == most ? std::to_string(least) : std::to_string(least) + " or " + std::to_string(most);
        throw SceneError(reader.where(), reader.describe() + " needs " + wanted + " bsdf inside, got " + std::to_string(inside.size()));
    }
    std::vector<uint> indices;
    for (const auto& bsdf : inside) indices.push_back(import(*bsdf.object));
    return indices;
}

MaskBsdf BsdfImporter::read_mask(ObjectReader& reader)
{
    MaskBsdf bsdf;
    bsdf.opacity = textures_.number(reader, "opacity", 0.5, 0.0, 1.0);
    bsdf.nested = nested(reader, 1, 1).front();
    return bsdf;
}

BlendBsdf BsdfImporter::read_blend(ObjectReader& reader)
{
    BlendBsdf bsdf;
    bsdf.weight = textures_.number(reader, "weight", 0.5, 0.0, 1.0);
    const auto inside = nested(reader, 2, 2);
    bsdf.nested[0] = inside[0];
    bsdf.nested[1] = inside[1];
    return bsdf;
}

TwoSidedBsdf BsdfImporter::read_two_sided(ObjectReader& reader)
{
    const auto sides = nested(reader, 1, 2);
    for (const uint side : sides) {
        const BsdfDescription& bsdf = bsdfs_[side];
        if (std::holds_alternative<TwoSidedBsdf>(bsdf.model)) throw SceneError(bsdf.where, "a twosided bsdf cannot hold another");
        if (transmits(bsdfs_, side)) throw SceneError(bsdf.where, "a bsdf that transmits light cannot be twosided");
    }
    return {sides.front(), sides.back()};
}

} // namespace sundog
