// Radius policies: how wide each query looks in an iteration, and what its photons teach for the next. One of the axes
// along which photon methods differ; any of them goes with any kernel and with the mean of independent estimates.
#pragma once

#include "methods/photon_pass.h"
#include "methods/standard_parameters.h"

#include <memory>

namespace sundog
{

// Whether a pixel's radius, as a checkpoint has it, can have come from the first one: radii shrink.
inline bool is_shrunk(float radius_squared, float first_radius)
{
    constexpr float rounding = 1.0001f;
    return radius_squared > 0.0f && radius_squared <= first_radius * first_radius * rounding;
}

class RadiusPolicy
{
public:
    virtual ~RadiusPolicy() = default;

    // The widest disk (scene units) that is looked at in iteration `iteration` (from 0), for which the map is built.
    virtual float widest(std::uint64_t iteration) const = 0;

    // Answers the queries of a pass that has been traced: gives them their radii, adds the estimate by their photons to the
    // camera's radiance, and what is known of its bias to the film's error estimate where there is one; then learns. The
    // radii follow from earlier iterations alone, so that estimates are independent of them.
    virtual void estimate(PhotonPass& pass, std::uint64_t iteration) = 0;

    virtual void serialize(StateArchive&) {} // what earlier iterations have taught
};

// The one that `radius_policy` names. Throws for parameters that belong to another.
std::unique_ptr<RadiusPolicy> make_radius_policy(RenderContext& context, const Parameters& parameters);

// By parameter:
//   fixed        the first radius for good: biased
//   schedule     one for all pixels, r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1)  [Knaus and Zwicker 2011]
//   local        a pixel's shrinks by the photons that it has found  [Hachisuka, Ogaki and Jensen 2008]
//   adaptive     a pixel's balances the bias and the variance that it has learned  [Kaplanyan and Dachsbacher 2013]
//   chi_squared  a pixel's shrinks where its photons do not lie evenly  [Lin et al. 2020]
std::unique_ptr<RadiusPolicy> make_fixed_radii(RenderContext& context, const Parameters& parameters);
std::unique_ptr<RadiusPolicy> make_scheduled_radii(RenderContext& context, const Parameters& parameters);
std::unique_ptr<RadiusPolicy> make_local_radii(RenderContext& context, const Parameters& parameters);
std::unique_ptr<RadiusPolicy> make_adaptive_radii(RenderContext& context, const Parameters& parameters);
std::unique_ptr<RadiusPolicy> make_chi_squared_radii(RenderContext& context, const Parameters& parameters);

// Throws for parameters that belong to another policy than the one in force.
void refuse_parameters_of_other_policies(const Parameters& parameters);

bool is_adaptive(const Parameters& parameters); // which finds Laplacians itself

ParameterSpec radius_policy_spec(const std::string& default_policy);
ParameterSpec significance_spec();
ParameterSpec shrink_spec();
ParameterSpec first_test_spec();

// Those that methods of averaged estimates have, with `kernel` and `radius_policy` as given.
std::vector<ParameterSpec> averaged_specs(const std::string& kernel, const std::string& policy);

} // namespace sundog
