#include "methods/bidirectional.h"

#include "methods/light_pass.h"
#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/photon_merging.h"
#include "stages/unbiased_gathering.h"
#include "stages/vertex_connections.h"

#include <algorithm>
#include <numbers>

namespace sundog
{
namespace
{

// Where connections find what merging would only blur, photons are wanted for light that nothing else finds: fewer will do.
constexpr double pixels_beside_connections = 2.0;
// Each photon gathered costs a shadow ray and some trials.
constexpr double pixels_of_gathering = 1.0;

bool resamples(const Parameters& parameters)
{
    return parameters.text("connections") == "resampled";
}

void refuse_picks_without_resampling(const Parameters& parameters)
{
    if (parameters.has("picks") && parameters.is_set("picks") && !resamples(parameters))
        parameters.refuse("picks", "picks is for light vertices that are resampled; use -p connections=resampled");
}

std::unique_ptr<ConnectionList> connection_list(Device& device, const Parameters& parameters, std::size_t paths)
{
    return resamples(parameters) ? make_resampled_connections(device, paths, static_cast<uint>(parameters.integer("picks")))
                     : make_own_connections(device, paths, sampler_kind(parameters));
}

class Bidirectional final : public Method
{
public:
    Bidirectional(RenderContext& context, const Parameters& parameters, JoinedBy joined_by, std::optional<RegularizationSchedule> schedule)
        : context_(context), joined_by_(joined_by), schedule_(schedule),
          camera_(context.device, context.camera, context.filter, sampler_kind(parameters), context.scene.surface_options()),
          light_subpaths_(context.device, context.scene, context.camera,
                          {light_path_count(parameters, camera_.count()), camera_.count(), path_rules(parameters), sampler_kind(parameters),
                           joined_by.connections, joined_by.photons != PhotonUse::none}),
          camera_subpaths_(context.device, context.scene, context.camera, camera_.count(), path_rules(parameters), sampler_kind(parameters),
                           joined_by.connections, schedule.has_value()),
          pool_(context.device, context.scene, std::max(light_subpaths_.paths(), camera_.count()))
    {
        if (joined_by.connections)
            connections_.emplace(context.device, context.scene, camera_.count(), path_rules(parameters),
                                 connection_list(context.device, parameters, camera_.count()));
        if (joined_by.photons == PhotonUse::merged) {
            first_radius_ =
                joined_by.connections ? first_radius(context, parameters, pixels_beside_connections) : first_radius(context, parameters);
            alpha_ = parameters.real("alpha");
            merging_.emplace(context.device, context.scene, path_rules(parameters), density_kernel(parameters));
        } else if (joined_by.photons == PhotonUse::gathered) {
            first_radius_ = first_radius(context, parameters, pixels_of_gathering);
            gathering_.emplace(context.device, context.scene, camera_.count(), path_rules(parameters));
        }
    }

    void render_pass(std::uint64_t iteration) override
    {
        const SamplerKey key = sampler_key(context_.seed, iteration);
        const float radius = static_cast<float>(scheduled_radius(first_radius_, alpha_, 2, iteration));
        const Techniques techniques = techniques_of(radius);
        const Regularization regularization = schedule_ ? schedule_->at(iteration) : Regularization{};
        light_subpaths_.trace(context_.scene, camera_, pool_, key, techniques);
        if (merging_) merging_->build(light_subpaths_, radius);
        if (gathering_) gathering_->build(light_subpaths_, radius);

        camera_.start(context_.scene, pool_, key);
        if (context_.film.begin_first_hits(iteration)) camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        const ConnectedSubpaths subpaths{pool_, camera_subpaths_, light_subpaths_, key};
        if (connections_) light_subpaths_.add_splats(camera_.radiance);
        for (;;) {
            camera_subpaths_.shade(context_.scene, camera_, pool_, key, techniques, regularization);
            if (connections_) connections_->connect(context_.scene, subpaths, camera_.radiance);
            if (merging_) merging_->merge(pool_, camera_subpaths_, techniques, camera_.radiance);
            if (!pool_.keep_alive()) break;
            pool_.trace(context_.scene);
            if (gathering_) gathering_->gather(context_.scene, subpaths, camera_.radiance);
        }
        photons_stored_ += light_subpaths_.photons_stored();
        context_.spectral.to_rgb(camera_.radiance);
        context_.film.accumulate(camera_.radiance);
    }

    MethodCounters counters() const override
    {
        const std::uint64_t iterations = context_.film.iterations();
        return {iterations * light_subpaths_.paths(), iterations * camera_.count(), photons_stored_, pool_.rays_traced() + (gathering_ ? gathering_->trials() : 0)};
    }

    void serialize(StateArchive& archive) override
    {
        archive.count("photons stored", photons_stored_);
        pool_.serialize(archive);
        light_subpaths_.serialize(archive);
        if (gathering_) gathering_->serialize(archive);
    }

private:
    Techniques techniques_of(float radius) const
    {
        const float paths = static_cast<float>(light_subpaths_.paths());
        const float merge = std::numbers::pi_v<float> * radius * radius * paths;
        return {merge, merge > 0.0f ? 1.0f / merge : 0.0f, gathering_ ? 0.0f : merge, joined_by_.connections ? 1.0f : 0.0f, paths};
    }

    RenderContext& context_;
    JoinedBy joined_by_;
    std::optional<RegularizationSchedule> schedule_;
    CameraPaths camera_;
    LightSubpaths light_subpaths_;
    CameraSubpaths camera_subpaths_;
    PathPool pool_;
    std::optional<VertexConnections> connections_;
    std::optional<PhotonMerging> merging_;
    std::optional<UnbiasedGathering> gathering_;
    double first_radius_ = 0.0, alpha_ = 1.0;
    std::uint64_t photons_stored_ = 0;
};

} // namespace

std::unique_ptr<Method> make_bidirectional(RenderContext& context, const Parameters& parameters, JoinedBy joined_by,
                                           std::optional<RegularizationSchedule> schedule)
{
    refuse_picks_without_resampling(parameters);
    return std::make_unique<Bidirectional>(context, parameters, joined_by, schedule);
}

bool has_connections(const Parameters& parameters)
{
    return parameters.text("connections") != "none";
}

std::vector<ParameterSpec> joined(std::vector<ParameterSpec> first, const std::vector<ParameterSpec>& second)
{
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

std::vector<ParameterSpec> connection_specs(const std::vector<std::string>& choices)
{
    const bool may_be_left_out = std::find(choices.begin(), choices.end(), "none") != choices.end();
    return {
        light_choice_spec(),
        {"connections", ParameterType::choice, "own", "",
         "Light vertices that a camera vertex connects to: all of one light subpath, its own, or some that are resampled from all light "
         "subpaths (Davidovic et al. 2014)" +
             std::string(may_be_left_out ? "; none also leaves out next-event estimation and light tracing." : "."),
         0, 0, choices},
        {"picks",
         ParameterType::integer,
         "1",
         "vertices",
         "How many light vertices each camera vertex connects to where they are resampled.",
         1,
         4,
         {}}};
}

std::vector<ParameterSpec> bidirectional_specs()
{
    return {photons_spec(), max_depth_spec(), rr_depth_spec(rr_depth_of_subpaths, "subpaths: of the camera by throughput, of lights by albedo"),
            sampler_spec(), spectral_spec(), iterations_spec()};
}

std::vector<ParameterSpec> merging_specs()
{
    ParameterSpec radius = radius_spec();
    radius.description = "Radius of the first iteration's merges; 0: two pixels beside connections, four without, or less where light subpaths are many.";
    ParameterSpec alpha = alpha_spec();
    alpha.default_value = "0.75";
    alpha.description =
        "How slowly the radius shrinks (Knaus and Zwicker 2011): 2/3 is best where merging finds most of the light, 1 keeps it.";
    return {radius, alpha, kernel_spec("uniform")};
}

} // namespace sundog
