#include "import/bsdf_import.h"

#include "scene/materials.h"

namespace sundog
{

namespace
{

constexpr const char* supported_bsdfs = "diffuse, dielectric, thindielectric, conductor, twosided, null";

bool transmits(const BsdfDescription& bsdf)
{
    return std::holds_alternative<DielectricBsdf>(bsdf.model) || std::holds_alternative<NullBsdf>(bsdf.model);
}

} // namespace

uint BsdfImporter::import(const XmlElement& element)
{
    if (const auto found = imported_.find(&element); found != imported_.end()) return found->second;
    // A twosided that refers to itself is caught below it as nested twosided, so this recursion ends.
    ObjectReader reader(element, index_);
    auto model = read(reader);
    reader.finish();
    const uint index = add(element, std::move(model));
    imported_[&element] = index;
    return index;
}

uint BsdfImporter::add_diffuse(const std::string& id, const SourceLocation& where, Vec3 reflectance)
{
    bsdfs_.push_back({id, where, DiffuseBsdf{reflectance}});
    return static_cast<uint>(bsdfs_.size() - 1);
}

uint BsdfImporter::add(const XmlElement& element, decltype(BsdfDescription::model) model)
{
    const std::string* id = element.attribute("id");
    bsdfs_.push_back({id ? *id : "", element.where, std::move(model)});
    return static_cast<uint>(bsdfs_.size() - 1);
}

decltype(BsdfDescription::model) BsdfImporter::read(ObjectReader& reader)
{
    const std::string type = reader.type();
    const Vec3 half{0.5f, 0.5f, 0.5f};
    if (type == "diffuse") {
        const char* name = reader.has("diffuse_reflectance") ? "diffuse_reflectance" : "reflectance"; // 0.6 has both
        return DiffuseBsdf{reader.color(name, half, ColorRole::reflectance)};
    }
    if (type == "dielectric" || type == "thindielectric") return read_dielectric(reader, type == "thindielectric");
    if (type == "conductor") return read_conductor(reader);
    if (type == "null") return NullBsdf{};
    if (type == "twosided") return read_two_sided(reader);
    reader.unsupported(supported_bsdfs);
}

DielectricBsdf BsdfImporter::read_dielectric(ObjectReader& reader, bool thin)
{
    DielectricBsdf bsdf;
    bsdf.thin = thin;
    bsdf.int_ior = reader.ior("int_ior", "bk7");
    bsdf.ext_ior = reader.ior("ext_ior", "air");
    bsdf.specular_reflectance = reader.color("specular_reflectance", {1, 1, 1}, ColorRole::reflectance);
    bsdf.specular_transmittance = reader.color("specular_transmittance", {1, 1, 1}, ColorRole::reflectance);
    return bsdf;
}

ConductorBsdf BsdfImporter::read_conductor(ObjectReader& reader)
{
    ConductorBsdf bsdf;
    if (reader.has("material") && (reader.has("eta") || reader.has("k")))
        throw SceneError(reader.where_of("material"), "give a conductor either material or eta and k, not both");
    if (reader.has("eta") || reader.has("k")) {
        bsdf.eta = reader.color("eta", {0, 0, 0}, ColorRole::index);
        bsdf.k = reader.color("k", {1, 1, 1}, ColorRole::index);
    } else {
        const std::string material = reader.text("material", index_.legacy() ? "Cu" : "none");
        const auto constants = find_conductor(material);
        if (!constants)
            throw SceneError(reader.where_of("material"), "unknown conductor material '" + material + "'; known are " + conductor_names());
        bsdf.eta = constants->eta;
        bsdf.k = constants->k;
    }
    if (reader.has("ext_eta")) {
        const float exterior = reader.ior("ext_eta", "air");
        bsdf.eta = bsdf.eta / exterior;
        bsdf.k = bsdf.k / exterior;
    }
    bsdf.specular_reflectance = reader.color("specular_reflectance", {1, 1, 1}, ColorRole::reflectance);
    return bsdf;
}

TwoSidedBsdf BsdfImporter::read_two_sided(ObjectReader& reader)
{
    const auto sides = reader.nested("bsdf");
    if (sides.empty() || sides.size() > 2)
        throw SceneError(reader.where(), "twosided needs one bsdf or two (front, back) inside, got " + std::to_string(sides.size()));
    TwoSidedBsdf bsdf;
    for (std::size_t i = 0; i < sides.size(); i++) {
        const std::string* type = sides[i].object->attribute("type");
        if (type && *type == "twosided") throw SceneError(sides[i].where, "a twosided bsdf cannot hold another");
        const uint side = import(*sides[i].object);
        if (transmits(bsdfs_[side])) throw SceneError(sides[i].where, "a bsdf that transmits light ('" + *type + "') cannot be twosided");
        if (i == 0) bsdf.front = side;
        bsdf.back = side;
    }
    return bsdf;
}

} // namespace sundog
