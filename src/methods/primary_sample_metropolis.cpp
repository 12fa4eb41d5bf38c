#include "methods/primary_sample_metropolis.h"

#include "base/log.h"
#include "methods/render_context.h"
#include "methods/standard_parameters.h"
#include "stages/chain_radiance.h"
#include "stages/primary_sample_paths.h"

#include <algorithm>
#include <bit>

namespace sundog
{
namespace
{

// Enough at a time to keep a device busy, few enough for each to be long.
constexpr std::size_t most_default_chains = 16384;
// Resolved at a time: the image is all that needs room for every pixel.
constexpr std::size_t pixels_at_a_time = 65536;
// A path of more vertices goes on with numbers that are independent in each mutation, which its chain does not remember.
constexpr uint most_vertices = 16;

bool is_bidirectional(const Parameters& parameters)
{
    return parameters.text("paths") == "bdpt";
}

std::size_t chain_count(const Parameters& parameters, std::size_t pixels)
{
    const std::int64_t chains = parameters.integer("chains");
    return chains > 0 ? static_cast<std::size_t>(chains) : std::min(pixels, most_default_chains);
}

// One mutation a pixel and iteration, or one of each chain where they are more.
uint steps_per_iteration(std::size_t pixels, std::size_t chains)
{
    return static_cast<uint>((pixels + chains - 1) / chains);
}

MarkovChainSettings chain_settings(const Parameters& parameters, std::size_t pixels, std::uint64_t seed)
{
    const std::size_t chains = chain_count(parameters, pixels);
    // The camera, and a vertex for each edge but the last.
    const uint vertices = std::min(path_rules(parameters).max_depth, most_vertices);
    return {chains, steps_per_iteration(pixels, chains), std::max(vertices, 1u) + 1u, parameters.real("large_step"), seed};
}

class PrimarySampleMetropolis final : public Method
{
public:
    PrimarySampleMetropolis(RenderContext& context, const Parameters& parameters, std::optional<RegularizationSchedule> schedule)
        : context_(context), schedule_(schedule), pixels_(context.film.pixel_count()), settings_(chain_settings(parameters, pixels_, context.seed)),
          seeds_(static_cast<std::size_t>(parameters.integer("seeds"))), bidirectional_(is_bidirectional(parameters)),
          camera_(context.device, context.camera, context.filter, SamplerKind::sobol, context.scene.surface_options()),
          pool_(context.device, context.scene, std::max(pixels_, settings_.chains)), chains_(context.device, settings_),
          paths_((bidirectional_ ? make_bidirectional_sample_paths : make_camera_sample_paths)(
              context.device, context.scene, context.camera, context.filter, {settings_.chains, pixels_, path_rules(parameters), schedule.has_value()})),
          splats_(context.device, pixels_, settings_.chains * (1 + std::size_t(settings_.steps)) * (bidirectional_ ? 3 : 1)),
          chain_radiance_(context.device, pixels_)
    {
    }

    void render_pass(std::uint64_t iteration) override
    {
        camera_.start(context_.scene, pool_, sampler_key(context_.seed, iteration));
        if (context_.film.begin_first_hits(iteration)) camera_.record_first_hits(context_.scene, pool_, iteration, context_.film.first_hits);
        context_.film.begin_update(); // every mutation changes a chain
        if (schedule_) regularize(iteration);
        if (!chains_.started()) start_chains();
        if (chains_.started()) {
            for (uint step = 0; step < settings_.steps; step++) mutate(iteration * settings_.steps + step);
            add_splats();
            chain_radiance_.add_to(camera_.radiance, chains_.scale());
        }
        context_.film.accumulate(camera_.radiance);
    }

    // Every iteration's share with b as it is known now.
    void resolve(Image& image) const override
    {
        const double factor = chains_.started() ? chains_.scale() : chain_radiance_.factor();
        const float inverse_iterations = 1.0f / static_cast<float>(context_.film.iterations());
        for (std::size_t first = 0; first < pixels_; first += pixels_at_a_time) {
            const std::vector<Vec3> correction = chain_radiance_.correction(factor, first, std::min(pixels_at_a_time, pixels_ - first));
            for (std::size_t i = 0; i < correction.size(); i++) {
                float* pixel = &image.pixels[context_.film.pixel_of_path(first + i) * image.channels.size()];
                pixel[0] += correction[i].x * inverse_iterations;
                pixel[1] += correction[i].y * inverse_iterations;
                pixel[2] += correction[i].z * inverse_iterations;
            }
        }
    }

    MethodCounters counters() const override
    {
        const std::uint64_t samples = chains_.proposed() + chains_.seeds();
        MethodCounters counters{bidirectional_ ? samples : 0, samples, 0, pool_.rays_traced()};
        counters.mutations = chains_.proposed();
        counters.mutations_accepted = chains_.accepted();
        return counters;
    }

    void serialize(StateArchive& archive) override
    {
        pool_.serialize(archive);
        chains_.serialize(archive);
        splats_.serialize(archive, chains_);
        chain_radiance_.serialize(archive);
        paths_->serialize(archive);
    }

private:
    // What a state contributes depends on the angle. It stays as it is while iterations double in number, and then chains start anew.
    void regularize(std::uint64_t iteration)
    {
        const std::uint64_t first = std::bit_floor(iteration + 1) - 1; // of those that share the angle
        paths_->regularize(schedule_->at(first));
        if (iteration > 0 && iteration == first && chains_.started()) {
            chain_radiance_.settle(chains_.scale(), camera_.radiance);
            chains_.forget();
            splats_.clear();
        }
    }

    void start_chains()
    {
        const bool found =
            chains_.start(seeds_, [this]() -> const Buffer<float>& { return paths_->trace(context_.scene, pool_, chains_); });
        if (found)
            leave_splats(0);
        else
            log_warning("none of " + std::to_string(seeds_) + " samples found light, so this iteration is black: raise seeds (-p seeds=N), " +
                        (schedule_ ? "let the cone narrow more slowly (-p rate=R), " : "") + "or choose sppm (-m sppm)");
    }

    void mutate(std::uint64_t step)
    {
        chains_.propose(step);
        const Buffer<float>& contributions = paths_->trace(context_.scene, pool_, chains_);
        if (!splats_.has_room_for(paths_->splat_count())) add_splats();
        leave_splats(chains_.next_sample());
        chains_.accept(contributions);
    }

    void leave_splats(uint first_sample)
    {
        splats_.reserve(paths_->splat_count());
        paths_->leave_splats(first_sample, splats_);
    }

    // Sums of an iteration over its mutations; each is worth as much as a path in every pixel.
    void add_splats()
    {
        const double mutations = static_cast<double>(settings_.steps) * static_cast<double>(settings_.chains);
        splats_.add_to(camera_.radiance, chain_radiance_.radiance, chains_, static_cast<float>(static_cast<double>(pixels_) / mutations));
        chains_.renumber_samples();
    }

    RenderContext& context_;
    std::optional<RegularizationSchedule> schedule_;
    std::size_t pixels_;
    MarkovChainSettings settings_;
    std::size_t seeds_;
    bool bidirectional_;
    CameraPaths camera_;
    PathPool pool_;
    MarkovChains chains_;
    std::unique_ptr<PrimarySamplePaths> paths_;
    ChainSplats splats_;
    ChainRadiance chain_radiance_;
};

} // namespace

std::unique_ptr<Method> make_primary_sample_metropolis(RenderContext& context, const Parameters& parameters,
                                                       std::optional<RegularizationSchedule> schedule)
{
    return std::make_unique<PrimarySampleMetropolis>(context, parameters, schedule);
}

std::vector<ParameterSpec> chain_specs()
{
    return {
         {"chains",
          ParameterType::integer,
          "0",
          "chains",
          "Markov chains side by side; 0: one a pixel, at most 16384. An iteration mutates each so often that there is one mutation a "
          "pixel or more.",
          0,
          1e8,
          {}},
         {"large_step", ParameterType::real, "0.3", "", "Probability of a mutation that forgets the chain's state.", 0.01, 1.0, {}},
         {"seeds",
          ParameterType::integer,
          "100000",
          "samples",
          "Independent samples before the first iteration, which say how bright the image is and where chains start.",
          1,
          1e8,
          {}}};
}

} // namespace sundog
