#include "methods/radius_policy.h"

#include <algorithm>
#include <fmt/format.h>

namespace sundog
{

namespace
{

struct Policy {
    const char* name;
    std::unique_ptr<RadiusPolicy> (*make)(RenderContext&, const Parameters&);
    std::vector<std::string> parameters;
};

const std::vector<Policy>& policies()
{
    static const std::vector<Policy> all{{"fixed", make_fixed_radii, {}},
                                         {"schedule", make_scheduled_radii, {"alpha"}},
                                         {"local", make_local_radii, {"alpha"}},
                                         {"adaptive", make_adaptive_radii, {}},
                                         {"chi_squared", make_chi_squared_radii, {"significance", "shrink", "first_test"}}};
    return all;
}

bool takes(const Policy& policy, const std::string& parameter)
{
    return std::find(policy.parameters.begin(), policy.parameters.end(), parameter) != policy.parameters.end();
}

const Policy& policy_in_force(const Parameters& parameters)
{
    const auto named = [&](const Policy& policy) { return policy.name == parameters.text("radius_policy"); };
    return *std::find_if(policies().begin(), policies().end(), named);
}

} // namespace

void refuse_parameters_of_other_policies(const Parameters& parameters)
{
    const Policy& policy = policy_in_force(parameters);
    for (const Policy& other : policies())
        for (const std::string& name : other.parameters)
            if (parameters.is_set(name) && !takes(policy, name))
                parameters.refuse(name, fmt::format("{} means nothing with radius_policy={}; it belongs to radius_policy={}", name,
                                                    policy.name, other.name));
}

std::unique_ptr<RadiusPolicy> make_radius_policy(RenderContext& context, const Parameters& parameters)
{
    refuse_parameters_of_other_policies(parameters);
    return policy_in_force(parameters).make(context, parameters);
}

bool is_adaptive(const Parameters& parameters)
{
    return parameters.text("radius_policy") == "adaptive";
}

ParameterSpec radius_policy_spec(const std::string& default_policy)
{
    return {"radius_policy",
            ParameterType::choice,
            default_policy,
            "",
            "What radii follow from: nothing (fixed; biased); a schedule for all pixels (Knaus and Zwicker 2011); or each pixel's count of "
            "photons (local; Hachisuka et "
            "al. 2008), bias and variance (adaptive; Kaplanyan and Dachsbacher 2013), or test of evenness (chi_squared; Lin et al. 2020).",
            0,
            0,
            {"fixed", "schedule", "local", "adaptive", "chi_squared"}};
}

std::vector<ParameterSpec> averaged_specs(const std::string& kernel, const std::string& policy)
{
    return {photons_spec(),      radius_spec(),       radius_policy_spec(policy), alpha_spec(),
            significance_spec(), shrink_spec(),       first_test_spec(),          kernel_spec(kernel),
            direct_spec(),       light_choice_spec(), max_depth_spec(),           rr_depth_spec(1, "light subpaths, by albedo"),
            sampler_spec(),      spectral_spec(),     iterations_spec()};
}

} // namespace sundog
