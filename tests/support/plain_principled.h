// The principled BSDF in double precision, all parts together, from the papers [Burley 2012; Burley 2015; Walter et al.
// 2007] and in Mitsuba 3's arrangement; for parameters that are numbers.
#pragma once

#include "support/plain_bsdf.h"

namespace sundog
{

class PlainPrincipled
{
public:
    explicit PlainPrincipled(const PrincipledBsdf& bsdf) : bsdf_(bsdf), eta_(bsdf.eta)
    {
        const double aspect = std::sqrt(1.0 - 0.9 * number(bsdf.anisotropic)), r = number(bsdf.roughness);
        alpha_u_ = std::max(1e-3, r * r / aspect);
        alpha_v_ = std::max(1e-3, r * r * aspect);
    }

    // f of red, for radiance; o and i in the frame of the tangent, the bitangent and the normal.
    double operator()(Vec3d o, Vec3d i) const
    {
        if (o.z * i.z > 0.0) return o.z > 0.0 ? outside(o, i) : inside(o, i);
        return transmission(o, i);
    }

private:
    static double number(const NumberSource& source) { return static_cast<double>(source.value); }
    double metallic() const { return number(bsdf_.metallic); }
    double color() const { return static_cast<double>(bsdf_.base_color.value.x); }
    double hue() const
    {
        const Vec3 c = bsdf_.base_color.value;
        const double luminance = 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) + 0.0722 * static_cast<double>(c.z);
        return luminance > 0.0 ? color() / luminance : 1.0;
    }
    static double fifth(double cosine) { return std::pow(std::clamp(1.0 - cosine, 0.0, 1.0), 5.0); }
    double schlick(double f0, double cosine) const
    {
        if (eta_ < 1.0) cosine = std::sqrt(std::max(0.0, 1.0 - (1.0 - cosine * cosine) / (eta_ * eta_)));
        return f0 + (1.0 - f0) * fifth(cosine);
    }
    static double masking(Vec3d v, double alpha_u, double alpha_v)
    {
        const double tan2 = (alpha_u * alpha_u * v.x * v.x + alpha_v * alpha_v * v.y * v.y) / (v.z * v.z);
        return 2.0 / (1.0 + std::sqrt(1.0 + tan2));
    }
    // D G of the main facets.
    double facets(Vec3d o, Vec3d i, Vec3d h) const
    {
        const double slope = std::pow(h.x / alpha_u_, 2) + std::pow(h.y / alpha_v_, 2) + h.z * h.z;
        return masking(o, alpha_u_, alpha_v_) * masking(i, alpha_u_, alpha_v_) / (pi * alpha_u_ * alpha_v_ * slope * slope);
    }

    double outside(Vec3d o, Vec3d i) const
    {
        const Vec3d h = normalized(o + i);
        const double cos_d = dot(h, i), opaque = (1.0 - metallic()) * (1.0 - number(bsdf_.spec_trans));
        const double wo = fifth(o.z), wi = fifth(i.z), retro = 2.0 * number(bsdf_.roughness) * cos_d * cos_d;
        const double burley = (1.0 - wo / 2.0) * (1.0 - wi / 2.0) + retro * (wo + wi + wo * wi * (retro - 1.0));
        const double fss = (1.0 + (retro / 2.0 - 1.0) * wo) * (1.0 + (retro / 2.0 - 1.0) * wi);
        const double subsurface = 1.25 * (fss * (1.0 / (o.z + i.z) - 0.5) + 0.5), flatness = number(bsdf_.flatness);
        double f = opaque * color() / pi * ((1.0 - flatness) * burley + flatness * subsurface);
        const double sheen_color = 1.0 + number(bsdf_.sheen_tint) * (hue() - 1.0);
        f += (1.0 - metallic()) * number(bsdf_.sheen) * sheen_color * fifth(cos_d);
        f += coat(o, i, h);
        const double tint = number(bsdf_.spec_tint), r0 = std::pow((eta_ - 1.0) / (eta_ + 1.0), 2);
        const double fresnel = metallic() * schlick(color(), cos_d) +
                               (1.0 - metallic()) * (tint * schlick(hue() * r0, cos_d) + (1.0 - tint) * fresnel_reflectance(cos_d, eta_));
        return eta_ == 1.0 ? f : f + fresnel * facets(o, i, h) / (4.0 * o.z * i.z);
    }
    double coat(Vec3d o, Vec3d i, Vec3d h) const
    {
        const double alpha = 0.1 - 0.099 * number(bsdf_.clearcoat_gloss), a2 = alpha * alpha;
        const double d = (a2 - 1.0) / (pi * std::log(a2) * (1.0 + (a2 - 1.0) * h.z * h.z));
        return 0.25 * number(bsdf_.clearcoat) * schlick(0.04, dot(h, i)) * d * masking(o, 0.25, 0.25) * masking(i, 0.25, 0.25);
    }
    double inside(Vec3d o, Vec3d i) const
    {
        const Vec3d h = normalized(-(o + i)), up_o = -o, up_i = -i;
        return (1.0 - metallic()) * number(bsdf_.spec_trans) * fresnel_reflectance(dot(h, up_o), 1.0 / eta_) * facets(up_o, up_i, h) /
               (4.0 * up_o.z * up_i.z);
    }
    double transmission(Vec3d o, Vec3d i) const
    {
        const double eta = o.z > 0.0 ? eta_ : 1.0 / eta_; // of i's side over o's
        Vec3d h = normalized(o + i * eta);
        if (h.z < 0.0) h = -h;
        const double cos_o = dot(o, h), cos_i = dot(i, h);
        if (cos_o * o.z <= 0.0 || cos_i * i.z <= 0.0) return 0.0;
        const double through = 1.0 - fresnel_reflectance(std::abs(cos_o), eta);
        const double jacobian = std::abs(cos_o * cos_i / (o.z * i.z)) * eta * eta / std::pow(cos_o + eta * cos_i, 2);
        return (1.0 - metallic()) * number(bsdf_.spec_trans) * std::sqrt(color()) * through * facets(o, i, h) * jacobian / (eta * eta);
    }

    PrincipledBsdf bsdf_;
    double eta_;
    double alpha_u_, alpha_v_;
};

} // namespace sundog
