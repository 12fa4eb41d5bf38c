#include "methods/averaged_photon_mapping.h"

#include "methods/radius_policy.h"

namespace sundog
{
namespace
{

class AveragedPhotonMapping final : public Method
{
public:
    AveragedPhotonMapping(RenderContext& context, const Parameters& parameters)
        : context_(context), policy_(make_radius_policy(context, parameters)), pass_(context, parameters, is_adaptive(parameters))
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        pass_.trace(iteration, policy_->widest(iteration));
        policy_->estimate(pass_, iteration);
        context_.spectral.to_rgb(pass_.camera.radiance);
        context_.film.accumulate(pass_.camera.radiance);
    }

    MethodCounters counters() const override { return pass_.counters(); }

    void serialize(StateArchive& archive) override
    {
        pass_.serialize(archive);
        policy_->serialize(archive);
    }

private:
    RenderContext& context_;
    std::unique_ptr<RadiusPolicy> policy_;
    PhotonPass pass_;
};

} // namespace

std::unique_ptr<Method> make_averaged_photon_mapping(RenderContext& context, const Parameters& parameters)
{
    return std::make_unique<AveragedPhotonMapping>(context, parameters);
}

} // namespace sundog
