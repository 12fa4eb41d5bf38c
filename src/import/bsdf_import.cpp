#include "import/bsdf_import.h"

#include "import/limits.h"
#include "import/principled_import.h"
#include "import/text_file.h"
#include "scene/materials.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace sundog
{

namespace
{

constexpr const char* supported_bsdfs = "diffuse, dielectric, roughdielectric, thindielectric, conductor, roughconductor, plastic, "
                                        "roughplastic, principled, phong, coating, roughcoating, mask, blendbsdf, mixturebsdf, normalmap, bumpmap, twosided, null";
constexpr uint max_nesting = 6; // of masks and blends: the device has room for a few more
constexpr double max_alpha = 100.0; // facets are all but upright beyond
constexpr double largest_bump_scale = 1e9; // the square of a slope stays finite
constexpr double max_exponent = 1e5; // beyond it single precision has no digits for the lobe

// BSDFs of Mitsuba that are refused, and what comes near them.
struct Refusal {
    const char* type;
    const char* cure;
};
constexpr Refusal refusals[] = {
    {"ward", "use principled with its roughness and anisotropic, or blendbsdf of diffuse and roughconductor"},
    {"difftrans", "use diffuse, or roughdielectric"},
    {"hk", "use diffuse"},
    {"irawan", "use diffuse with a bitmap"},
    {"hair", "use roughdielectric, or roughconductor"},
    {"measured", "use roughconductor, or roughplastic"},
    {"measured_polarized", "use roughconductor, or roughplastic"},
    {"pplastic", "use plastic, or roughplastic: light is not polarised here"},
    {"principledthin", "use thindielectric, or blendbsdf of it and a twosided principled"},
    {"openpbr", "use principled"},
    {"neuralbsdf", "use principled"},
    {"polarizer", "use mask over null to dim light: it is not polarised here"},
    {"retarder", "use null: light is not polarised here"},
    {"circular", "use mask over null to dim light: it is not polarised here"},
};

// Whether a layer may lie over it: opaque lobes about the surface's own normal, without an interface of their own.
bool can_be_coated(const std::vector<BsdfDescription>& bsdfs, uint index)
{
    const auto& model = bsdfs[index].model;
    if (const auto* blend = std::get_if<BlendBsdf>(&model)) return can_be_coated(bsdfs, blend->nested[0]) && can_be_coated(bsdfs, blend->nested[1]);
    return std::holds_alternative<DiffuseBsdf>(model) || std::holds_alternative<ConductorBsdf>(model) || std::holds_alternative<PhongBsdf>(model);
}

bool transmits(const std::vector<BsdfDescription>& bsdfs, uint index)
{
    const auto& model = bsdfs[index].model;
    if (const auto* blend = std::get_if<BlendBsdf>(&model)) return transmits(bsdfs, blend->nested[0]) || transmits(bsdfs, blend->nested[1]);
    if (const auto* map = std::get_if<NormalMapBsdf>(&model)) return transmits(bsdfs, map->nested);
    if (const auto* map = std::get_if<BumpMapBsdf>(&model)) return transmits(bsdfs, map->nested);
    if (const auto* principled = std::get_if<PrincipledBsdf>(&model)) return principled->transmits();
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

uint BsdfImporter::add_diffuse(const std::string& id, const SourceLocation& where, ColorSource reflectance)
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
    if (const auto* map = std::get_if<NormalMapBsdf>(&model)) return 1 + nesting(map->nested);
    if (const auto* map = std::get_if<BumpMapBsdf>(&model)) return 1 + nesting(map->nested);
    if (const auto* coating = std::get_if<CoatingBsdf>(&model)) return 1 + nesting(coating->nested);
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
    if (type == "plastic" || type == "roughplastic") return read_plastic(reader, type == "roughplastic");
    if (type == "principled") return read_principled(reader, textures_);
    if (type == "phong") return read_phong(reader);
    if (type == "coating" || type == "roughcoating") return read_coating(reader, type == "roughcoating");
    if (type == "null") return NullBsdf{};
    if (type == "mask") return read_mask(reader);
    if (type == "blendbsdf") return read_blend(reader);
    if (type == "normalmap") return read_normal_map(reader);
    if (type == "bumpmap") return read_bump_map(reader);
    if (type == "mixturebsdf") return read_mixture(reader);
    if (type == "twosided") return read_two_sided(reader);
    const auto refusal = std::find_if(std::begin(refusals), std::end(refusals), [&](const Refusal& r) { return type == r.type; });
    reader.missing(refusal != std::end(refusals) ? std::string(": ") + refusal->cure : std::string("; supported are ") + supported_bsdfs,
                   "a diffuse bsdf of reflectance 0.5 stands in for it");
    return DiffuseBsdf{};
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
    check_relative_index(bsdf.int_ior / bsdf.ext_ior, reader.where_of(reader.has("int_ior") ? "int_ior" : "ext_ior"));
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
    for (const auto& [name, index] : {std::pair("eta", bsdf.eta), std::pair("k", bsdf.k)})
        if (!(max_component(index) <= largest_complex_index))
            throw SceneError(reader.where_of(name), "'" + std::string(name) + "' of a conductor over the index outside must be at most 1e8");
    bsdf.specular_reflectance = reflectance(reader, "specular_reflectance", {1, 1, 1});
    return bsdf;
}

Roughness BsdfImporter::read_roughness(ObjectReader& reader)
{
    Roughness roughness;
    const std::string distribution = reader.text("distribution", "beckmann");
    if (distribution == "as" || distribution == "phong")
        throw SceneError(reader.where_of("distribution"),
                         "distribution '" + distribution + "' is not supported: use beckmann, with alpha = sqrt(2 / (exponent + 2))");
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

PlasticBsdf BsdfImporter::read_plastic(ObjectReader& reader, bool rough)
{
    PlasticBsdf bsdf;
    bsdf.int_ior = reader.ior("int_ior", "polypropylene");
    bsdf.ext_ior = reader.ior("ext_ior", "air");
    check_relative_index(bsdf.int_ior / bsdf.ext_ior, reader.where_of(reader.has("int_ior") ? "int_ior" : "ext_ior"));
    bsdf.diffuse_reflectance = reflectance(reader, "diffuse_reflectance", {0.5f, 0.5f, 0.5f});
    bsdf.specular_reflectance = reflectance(reader, "specular_reflectance", {1, 1, 1});
    bsdf.nonlinear = reader.boolean("nonlinear", false);
    if (!rough) return bsdf;
    if (reader.object("alpha", "texture"))
        throw SceneError(reader.where_of("alpha"), "'alpha' of a roughplastic must be a number, not a texture: use principled, or blendbsdf of two roughplastic");
    for (const char* name : {"alpha_u", "alpha_v"})
        reader.refuse(name, "the coat of plastic is as rough along u as along v: give it 'alpha'");
    bsdf.roughness = read_roughness(reader);
    return bsdf;
}

// What adds up to more than 1 in some channel is scaled to 0.99, as by 0.6 (BSDF::ensureEnergyConservation in its
// librender/bsdf.cpp), which takes the largest texel of a texture for it; here textures are left alone.
PhongBsdf BsdfImporter::read_phong(ObjectReader& reader)
{
    PhongBsdf bsdf;
    bsdf.diffuse_reflectance = reflectance(reader, "diffuse_reflectance", {0.5f, 0.5f, 0.5f});
    bsdf.specular_reflectance = reflectance(reader, "specular_reflectance", {0.2f, 0.2f, 0.2f});
    bsdf.exponent = textures_.number(reader, "exponent", 30.0, 0.0, max_exponent);
    if (bsdf.diffuse_reflectance.texture || bsdf.specular_reflectance.texture) return bsdf;
    const Vec3 sum = bsdf.diffuse_reflectance.value + bsdf.specular_reflectance.value;
    const float most = std::max({sum.x, sum.y, sum.z});
    if (most <= 1.0f) return bsdf;
    for (ColorSource* part : {&bsdf.diffuse_reflectance, &bsdf.specular_reflectance}) part->value = part->value * (0.99f / most);
    index_.warn(reader.where(), "diffuse_reflectance and specular_reflectance of a phong bsdf add up to more than 1 and were scaled to 0.99",
                WarningKind::approximated);
    return bsdf;
}

// 0.6: both index and absorption of a layer; the roughness is that of its surface.
CoatingBsdf BsdfImporter::read_coating(ObjectReader& reader, bool rough)
{
    CoatingBsdf bsdf;
    bsdf.int_ior = reader.ior("int_ior", "bk7");
    bsdf.ext_ior = reader.ior("ext_ior", "air");
    const double thickness = reader.number("thickness", 1.0);
    if (!(thickness >= 0.0 && thickness <= 1e30)) throw SceneError(reader.where_of("thickness"), "thickness of a " + reader.type() + " must be >= 0 and finite");
    bsdf.thickness = static_cast<float>(thickness);
    bsdf.sigma_a = textures_.color(reader, "sigma_a", {0, 0, 0}, ColorRole::index);
    bsdf.specular_reflectance = reflectance(reader, "specular_reflectance", {1, 1, 1});
    if (rough) {
        for (const char* name : {"alpha_u", "alpha_v"}) reader.refuse(name, "a coating is as rough along u as along v: give it 'alpha'");
        bsdf.roughness = read_roughness(reader);
    }
    bsdf.nested = nested(reader, 1, 1).front();
    if (!can_be_coated(bsdfs_, bsdf.nested))
        throw SceneError(bsdfs_[bsdf.nested].where, "a " + reader.type() + " may lie over diffuse, conductor, roughconductor, phong, and blends of these: "
                                                    "put twosided, normalmap, bumpmap and mask around the coating; in place of a coat of plastic or "
                                                    "principled, or of another coating, keep the outer coat alone");
    return bsdf;
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
    if (index_.legacy() && bsdf.opacity.texture && !textures_.is_gray(*bsdf.opacity.texture))
        index_.warn(reader.where_of("opacity"), "the opacity has colours; it counts by its luminance, where 0.6 lets each channel through by its own share",
                    WarningKind::approximated);
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

// 0.6 has neither the flip nor the shadowing.
template <class Map> void BsdfImporter::read_relief(ObjectReader& reader, Map& map)
{
    map.flip_invalid = reader.boolean("flip_invalid_normals", !index_.legacy());
    map.shadowing = reader.boolean("use_shadowing_function", !index_.legacy());
    map.nested = nested(reader, 1, 1).front();
}

NormalMapBsdf BsdfImporter::read_normal_map(ObjectReader& reader)
{
    NormalMapBsdf map;
    const auto texture = textures_.nested(reader);
    if (!texture) throw SceneError(reader.where(), "a normalmap needs a <texture> inside");
    map.normals = *texture;
    read_relief(reader, map);
    return map;
}

BumpMapBsdf BsdfImporter::read_bump_map(ObjectReader& reader)
{
    BumpMapBsdf map;
    const auto texture = textures_.nested(reader);
    if (!texture) throw SceneError(reader.where(), "a bumpmap needs a <texture> inside");
    const float scale = static_cast<float>(reader.number_between("scale", 1.0, -largest_bump_scale, largest_bump_scale)) * luminance(texture->value);
    map.heights = texture->texture ? NumberSource(scale, *texture->texture) : NumberSource(0.0f);
    read_relief(reader, map);
    return map;
}

// A balanced tree of blends, so that many parts are not nested deeply. Parts are imported as the tree needs them, in the
// order in which they are read again when the tree has been written.
uint BsdfImporter::blend_of(const SourceLocation& where, std::span<const WeightedBsdf> parts)
{
    if (parts.size() == 1) return parts.front().bsdf ? import(*parts.front().bsdf) : add_diffuse("", where, Vec3{0, 0, 0});
    const auto half = parts.subspan(0, parts.size() / 2), rest = parts.subspan(parts.size() / 2);
    const auto sum = [](std::span<const WeightedBsdf> some) {
        return std::accumulate(some.begin(), some.end(), 0.0, [](double total, const WeightedBsdf& part) { return total + part.weight; });
    };
    const double all = sum(parts);
    BlendBsdf blend;
    blend.weight = all > 0.0 ? static_cast<float>(sum(rest) / all) : 0.0f;
    blend.nested[0] = blend_of(where, half);
    blend.nested[1] = blend_of(where, rest);
    bsdfs_.push_back({"", where, blend});
    return static_cast<uint>(bsdfs_.size() - 1);
}

// 0.6: a sum of BSDFs with weights of at most 1 together; what is left is black.
BsdfImporter::Model BsdfImporter::read_mixture(ObjectReader& reader)
{
    const auto inside = reader.nested("bsdf");
    if (inside.empty()) throw SceneError(reader.where(), "a mixturebsdf needs bsdfs inside");
    const SourceLocation where = reader.where_of("weights");
    std::vector<WeightedBsdf> parts;
    double sum = 0.0;
    const std::string text = reader.text("weights", "");
    for (const std::string_view token : tokens(text)) {
        const auto weight = parse_number(token);
        if (!weight || *weight < 0.0 || *weight > 1.0)
            throw SceneError(where, "'weights' of a mixturebsdf must each be between 0 and 1, got '" + std::string(token) + "'");
        if (parts.size() == inside.size()) throw SceneError(where, "mixturebsdf has more weights than bsdfs inside: give one a bsdf");
        parts.push_back({inside[parts.size()].object, *weight});
        sum += *weight;
    }
    if (parts.size() < inside.size()) throw SceneError(where, "mixturebsdf has fewer weights than bsdfs inside: give one a bsdf");
    if (sum > 1.0 + 1e-6) throw SceneError(where, "the weights of a mixturebsdf must not add up to more than 1");
    if (sum < 1.0 - 1e-6) parts.push_back({nullptr, 1.0 - sum});
    if (parts.size() == 1) parts.push_back({parts.front().bsdf, 0.0});
    const uint blend = blend_of(reader.where(), parts);
    Model model = bsdfs_[blend].model;
    bsdfs_.pop_back(); // the caller adds it
    return model;
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
