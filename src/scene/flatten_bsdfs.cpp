#include "scene/flatten_bsdfs.h"

#include "scene/plastic_coat.h"

#include <algorithm>
#include <cmath>

namespace sundog {

namespace {

constexpr uint no_flags = 0;

Bsdf record(uint type, uint flags)
{
    const TexturedColor one{{1, 1, 1}, NO_TEXTURE};
    Bsdf bsdf{};
    bsdf.type = type;
    bsdf.flags = flags;
    bsdf.eta = 1.0f;
    bsdf.reflectance = bsdf.specular = bsdf.transmittance = one;
    bsdf.alpha_u = bsdf.alpha_v = bsdf.weight = {0.0f, NO_TEXTURE};
    return bsdf;
}

// A roughness that a texture gives may be anything.
bool is_broad(const Roughness& roughness)
{
    return roughness.alpha_u.texture || roughness.alpha_v.texture || std::min(roughness.alpha_u.value, roughness.alpha_v.value) >= NARROW_ALPHA;
}

uint lobe_flags(const std::optional<Roughness>& roughness)
{
    if (!roughness) return no_flags;
    return BSDF_HAS_SMOOTH | (is_broad(*roughness) ? BSDF_HAS_BROAD : 0u) | (roughness->beckmann ? BSDF_BECKMANN : 0u);
}

void set_roughness(Bsdf& bsdf, const std::optional<Roughness>& roughness)
{
    if (!roughness) return;
    bsdf.alpha_u = flatten(roughness->alpha_u);
    bsdf.alpha_v = flatten(roughness->alpha_v);
}

template <class Map> uint relief_flags(const Map& map)
{
    return (map.flip_invalid ? BSDF_FLIPS_NORMALS : 0u) | (map.shadowing ? BSDF_SHADOWS_RELIEF : 0u);
}

Vec3 first_three(const double (&values)[4])
{
    return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
}

void set_dispersion(Bsdf& bsdf, const SellmeierFormula& formula)
{
    bsdf.flags |= BSDF_DISPERSIVE;
    bsdf.eta_rgb = first_three(formula.b);
    bsdf.k_rgb = first_three(formula.c);
    bsdf.sellmeier_b4 = static_cast<float>(formula.b[3]);
    bsdf.sellmeier_c4 = static_cast<float>(formula.c[3]);
}

// Whether a query may meet its diffuse part, or facets that are not narrow.
bool is_broad(const PrincipledBsdf& bsdf)
{
    const auto always = [](const NumberSource& number) { return !number.texture && number.value >= 1.0f; };
    const bool diffuse = !always(bsdf.metallic) && (!always(bsdf.spec_trans) || bsdf.sheen.may_be_positive());
    const float alpha = bsdf.roughness.value * bsdf.roughness.value * std::sqrt(1.0f - 0.9f * bsdf.anisotropic.value);
    return diffuse || bsdf.roughness.texture || bsdf.anisotropic.texture || alpha >= NARROW_ALPHA;
}

// Of one description by itself; what it takes from nested ones comes later.
struct BsdfFlattener {
    uint& principled_count; // so far

    Bsdf operator()(const DiffuseBsdf& diffuse) const
    {
        Bsdf bsdf = record(BSDF_DIFFUSE, BSDF_HAS_SMOOTH | BSDF_HAS_BROAD | BSDF_BLACK_BACK);
        bsdf.reflectance = flatten(diffuse.reflectance);
        return bsdf;
    }
    Bsdf operator()(const DielectricBsdf& dielectric) const
    {
        const uint smooth = dielectric.thin ? BSDF_THIN_DIELECTRIC : BSDF_DIELECTRIC;
        // Ground glass is always followed, see NARROW_ALPHA.
        Bsdf bsdf = record(dielectric.roughness ? BSDF_ROUGH_DIELECTRIC : smooth, lobe_flags(dielectric.roughness) & ~BSDF_HAS_BROAD);
        bsdf.eta = dielectric.int_ior / dielectric.ext_ior;
        bsdf.specular = flatten(dielectric.specular_reflectance);
        bsdf.transmittance = flatten(dielectric.specular_transmittance);
        set_roughness(bsdf, dielectric.roughness);
        if (dielectric.dispersion) set_dispersion(bsdf, *dielectric.dispersion);
        return bsdf;
    }
    Bsdf operator()(const ConductorBsdf& conductor) const
    {
        Bsdf bsdf = record(conductor.roughness ? BSDF_ROUGH_CONDUCTOR : BSDF_CONDUCTOR, BSDF_BLACK_BACK | lobe_flags(conductor.roughness));
        bsdf.specular = flatten(conductor.specular_reflectance);
        bsdf.eta_rgb = conductor.eta;
        bsdf.k_rgb = conductor.k;
        set_roughness(bsdf, conductor.roughness);
        return bsdf;
    }
    Bsdf operator()(const PlasticBsdf& plastic) const
    {
        const uint coat = plastic.roughness && plastic.roughness->beckmann ? BSDF_BECKMANN : 0u;
        Bsdf bsdf = record(plastic.roughness ? BSDF_ROUGH_PLASTIC : BSDF_PLASTIC,
                           BSDF_HAS_SMOOTH | BSDF_HAS_BROAD | BSDF_BLACK_BACK | coat | (plastic.nonlinear ? BSDF_NONLINEAR : 0u));
        bsdf.eta = plastic.int_ior / plastic.ext_ior;
        bsdf.reflectance = flatten(plastic.diffuse_reflectance);
        bsdf.specular = flatten(plastic.specular_reflectance);
        if (!plastic.roughness) {
            bsdf.weight.value = smooth_internal_reflectance(bsdf.eta);
            return bsdf;
        }
        const float alpha = std::max(plastic.roughness->alpha_u.value, 1e-3f);
        const CoatTransmission transmission = rough_coat(bsdf.eta, alpha, plastic.roughness->beckmann);
        bsdf.alpha_u = bsdf.alpha_v = {alpha, NO_TEXTURE};
        bsdf.weight.value = transmission.internal_reflectance;
        const auto& c = transmission.series;
        bsdf.eta_rgb = {c[0], c[1], c[2]};
        bsdf.k_rgb = {c[3], c[4], c[5]};
        bsdf.transmittance.value = {c[6], c[7], c[8]};
        return bsdf;
    }
    Bsdf operator()(const PrincipledBsdf& principled) const
    {
        const bool transmits = principled.transmits();
        Bsdf bsdf = record(BSDF_PRINCIPLED, BSDF_HAS_SMOOTH | (is_broad(principled) ? BSDF_HAS_BROAD : 0u) |
                                                (transmits ? BSDF_TRANSMITS : BSDF_BLACK_BACK) |
                                                (principled.clearcoat.may_be_positive() ? BSDF_CLEARCOATED : 0u));
        bsdf.eta = principled.eta;
        bsdf.nested[0] = principled_count++;
        return bsdf;
    }
    Bsdf operator()(const PhongBsdf& phong) const
    {
        Bsdf bsdf = record(BSDF_PHONG, BSDF_HAS_SMOOTH | BSDF_HAS_BROAD | BSDF_BLACK_BACK);
        bsdf.reflectance = flatten(phong.diffuse_reflectance);
        bsdf.specular = flatten(phong.specular_reflectance);
        bsdf.alpha_u = bsdf.alpha_v = flatten(phong.exponent);
        return bsdf;
    }
    Bsdf operator()(const CoatingBsdf& coating) const
    {
        Bsdf bsdf = record(coating.roughness ? BSDF_ROUGH_COATING : BSDF_COATING, lobe_flags(coating.roughness));
        bsdf.eta = coating.int_ior / coating.ext_ior;
        bsdf.specular = flatten(coating.specular_reflectance);
        bsdf.transmittance = flatten(coating.sigma_a);
        bsdf.transmittance.value = bsdf.transmittance.value * coating.thickness;
        set_roughness(bsdf, coating.roughness);
        bsdf.nested[0] = coating.nested;
        return bsdf;
    }
    Bsdf operator()(const NullBsdf&) const { return record(BSDF_NULL, no_flags); }
    Bsdf operator()(const MaskBsdf& mask) const
    {
        Bsdf bsdf = record(BSDF_MASK, no_flags);
        bsdf.weight = flatten(mask.opacity);
        bsdf.nested[0] = mask.nested;
        return bsdf;
    }
    Bsdf operator()(const BlendBsdf& blend) const
    {
        Bsdf bsdf = record(BSDF_BLEND, no_flags);
        bsdf.weight = flatten(blend.weight);
        bsdf.nested[0] = blend.nested[0];
        bsdf.nested[1] = blend.nested[1];
        return bsdf;
    }
    Bsdf operator()(const NormalMapBsdf& map) const
    {
        Bsdf bsdf = record(BSDF_NORMAL_MAP, relief_flags(map));
        bsdf.reflectance = flatten(map.normals);
        bsdf.nested[0] = map.nested;
        return bsdf;
    }
    Bsdf operator()(const BumpMapBsdf& map) const
    {
        Bsdf bsdf = record(BSDF_BUMP_MAP, relief_flags(map));
        bsdf.weight = flatten(map.heights);
        bsdf.nested[0] = map.nested;
        return bsdf;
    }
    Bsdf operator()(const TwoSidedBsdf&) const { return record(BSDF_NULL, no_flags); } // replaced below
};

constexpr uint bit(uint n)
{
    return 1u << n;
}

// Of the record alone; nested BSDFs have records of their own.
uint lobes_of(const Bsdf& bsdf)
{
    switch (bsdf.type) {
    case BSDF_MASK:
        return bit(LOBE_NULL);
    case BSDF_BLEND:
    case BSDF_NORMAL_MAP:
    case BSDF_BUMP_MAP:
        return 0;
    case BSDF_PLASTIC:
        return bit(LOBE_CONDUCTOR) | bit(LOBE_COATED_DIFFUSE);
    case BSDF_ROUGH_PLASTIC:
        return bit(LOBE_ROUGH_CONDUCTOR) | bit(LOBE_COATED_DIFFUSE);
    case BSDF_PRINCIPLED:
        return bit(LOBE_PRINCIPLED_DIFFUSE) | bit(LOBE_PRINCIPLED_SPECULAR) | (bsdf.flags & BSDF_CLEARCOATED ? bit(LOBE_CLEARCOAT) : 0u) |
               (bsdf.flags & BSDF_TRANSMITS ? bit(LOBE_ROUGH_DIELECTRIC) : 0u);
    case BSDF_COATING:
        return bit(LOBE_CONDUCTOR);
    case BSDF_ROUGH_COATING:
        return bit(LOBE_ROUGH_CONDUCTOR);
    case BSDF_PHONG:
        return bit(LOBE_DIFFUSE) | bit(LOBE_PHONG);
    default:
        return bit(bsdf.type); // the first types are lobes
    }
}

constexpr uint inherited_flags = BSDF_HAS_SMOOTH | BSDF_HAS_BROAD; // from any part; BSDF_BLACK_BACK only from all

// Importers add nested BSDFs before those that hold them, so one pass in order sees all.
void take_from_nested(const BsdfDescription& description, std::vector<Bsdf>& bsdfs, std::size_t i)
{
    if (const auto* mask = std::get_if<MaskBsdf>(&description.model)) bsdfs[i].flags |= bsdfs.at(mask->nested).flags & (inherited_flags | BSDF_BLACK_BACK);
    if (const auto* coating = std::get_if<CoatingBsdf>(&description.model))
        bsdfs[i].flags |= bsdfs.at(coating->nested).flags & (inherited_flags | BSDF_BLACK_BACK);
    if (const auto* map = std::get_if<NormalMapBsdf>(&description.model))
        bsdfs[i].flags |= bsdfs.at(map->nested).flags & (inherited_flags | BSDF_BLACK_BACK);
    if (const auto* map = std::get_if<BumpMapBsdf>(&description.model))
        bsdfs[i].flags |= bsdfs.at(map->nested).flags & (inherited_flags | BSDF_BLACK_BACK);
    if (const auto* blend = std::get_if<BlendBsdf>(&description.model)) {
        const uint first = bsdfs.at(blend->nested[0]).flags, second = bsdfs.at(blend->nested[1]).flags;
        bsdfs[i].flags |= ((first | second) & inherited_flags) | (first & second & BSDF_BLACK_BACK);
    }
    if (const auto* sides = std::get_if<TwoSidedBsdf>(&description.model)) {
        // The front's record, which names the back's, itself a record of its own.
        bsdfs[i] = bsdfs.at(sides->front);
        bsdfs[i].flags &= ~BSDF_BLACK_BACK;
        bsdfs[i].flags |= BSDF_TWO_SIDED;
        bsdfs[i].back = sides->back;
    }
}

} // namespace

TexturedColor flatten(const ColorSource& color)
{
    return {color.value, color.texture.value_or(NO_TEXTURE)};
}

TexturedNumber flatten(const NumberSource& number)
{
    return {number.value, number.texture.value_or(NO_TEXTURE)};
}

std::vector<Bsdf> flatten_bsdfs(const std::vector<BsdfDescription>& descriptions)
{
    std::vector<Bsdf> bsdfs;
    uint principled_count = 0;
    for (const auto& description : descriptions) bsdfs.push_back(std::visit(BsdfFlattener{principled_count}, description.model));
    for (std::size_t i = 0; i < descriptions.size(); i++) take_from_nested(descriptions[i], bsdfs, i);
    return bsdfs;
}

std::vector<Principled> flatten_principled(const std::vector<BsdfDescription>& descriptions)
{
    std::vector<Principled> records;
    for (const auto& description : descriptions) {
        const auto* bsdf = std::get_if<PrincipledBsdf>(&description.model);
        if (!bsdf) continue;
        records.push_back({flatten(bsdf->base_color), flatten(bsdf->roughness), flatten(bsdf->anisotropic), flatten(bsdf->metallic),
                           flatten(bsdf->spec_trans), flatten(bsdf->spec_tint), flatten(bsdf->sheen), flatten(bsdf->sheen_tint),
                           flatten(bsdf->flatness), flatten(bsdf->clearcoat), flatten(bsdf->clearcoat_gloss)});
    }
    return records;
}

bool has_dispersion(std::span<const Bsdf> bsdfs)
{
    return std::any_of(bsdfs.begin(), bsdfs.end(), [](const Bsdf& bsdf) { return (bsdf.flags & BSDF_DISPERSIVE) != 0; });
}

uint bsdf_types(std::span<const Bsdf> bsdfs)
{
    uint types = 0;
    for (const Bsdf& bsdf : bsdfs) types |= 1u << bsdf.type;
    return types;
}

uint lobe_types(std::span<const Bsdf> bsdfs)
{
    uint lobes = 0;
    for (const Bsdf& bsdf : bsdfs) lobes |= lobes_of(bsdf);
    return lobes;
}

bool has_focusing_lobes(std::span<const Bsdf> bsdfs)
{
    constexpr uint broad = bit(LOBE_DIFFUSE) | bit(LOBE_COATED_DIFFUSE) | bit(LOBE_PRINCIPLED_DIFFUSE);
    return (lobe_types(bsdfs) & ~broad) != 0;
}

bool has_lobes_to_evaluate(std::span<const Bsdf> bsdfs)
{
    constexpr uint evaluated = bit(LOBE_ROUGH_CONDUCTOR) | bit(LOBE_ROUGH_DIELECTRIC) | bit(LOBE_COATED_DIFFUSE) |
                               bit(LOBE_PRINCIPLED_DIFFUSE) | bit(LOBE_PRINCIPLED_SPECULAR) | bit(LOBE_CLEARCOAT) | bit(LOBE_PHONG);
    constexpr uint changed = bit(BSDF_NORMAL_MAP) | bit(BSDF_BUMP_MAP) | bit(BSDF_COATING) | bit(BSDF_ROUGH_COATING); // even of diffuse ones
    return (lobe_types(bsdfs) & evaluated) != 0 || (bsdf_types(bsdfs) & changed) != 0;
}

} // namespace sundog
