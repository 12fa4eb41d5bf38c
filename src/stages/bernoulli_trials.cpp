#include "stages/bernoulli_trials.h"

#include <algorithm>
#include <utility>

namespace sundog
{

namespace
{

// Few waiting pairs make several trials each side by side, to keep a device busy and rounds few; those after the first success
// are made in vain.
constexpr std::size_t rays_of_a_short_round = 16384;
constexpr std::size_t most_trials_a_pair = 64;

} // namespace

BernoulliTrials::BernoulliTrials(Device& device, const DeviceScene& scene, std::size_t capacity, PathRules rules)
    : rules_(rules), begin_trials_(device, "begin_trials", "Begin trials", scene.surface_options()),
      propose_trials_(device, "propose_trials", "Propose trials", scene.surface_options()),
      trace_closest_(device, "trace_closest", "Trace trials", scene.trace_options()),
      judge_trials_(device, "judge_trials", "Judge trials"), compaction_(device, capacity), states_(device, capacity, "trial states"),
      flags_(device, capacity, "trial flags"), waiting_(device, capacity, "waiting pairs"), next_waiting_(device, capacity, "waiting pairs"),
      waiting_count_(device, 1, "waiting pairs count"), next_waiting_count_(device, 1, "waiting pairs count"),
      ray_count_(device, 1, "trial ray count"), rays_(device, capacity, "trial rays"), hits_(device, capacity, "trial hits"),
      trials_made_(device, capacity, "trials")
{
}

void BernoulliTrials::run(const DeviceScene& scene, const ConnectedSubpaths& subpaths, const ConnectedPairs& pairs, std::size_t count,
                          float radius)
{
    begin_trials_(count, radius, static_cast<uint>(count), pairs.pairs, subpaths.camera_subpaths.vertices,
                  subpaths.light_subpaths.vertices(), subpaths.pool.paths, pairs.occluded, pairs.radiance, states_, flags_);
    compaction_.keep(pairs.all(), flags_, pairs.count(), count, PATH_ALIVE, waiting_, waiting_count_);
    std::size_t waiting = waiting_count_.read(0);
    while (waiting > 0) waiting = run_round(scene, subpaths, pairs, waiting, radius);
}

std::size_t BernoulliTrials::run_round(const DeviceScene& scene, const ConnectedSubpaths& subpaths, const ConnectedPairs& pairs,
                                       std::size_t waiting, float radius)
{
    const std::size_t per_pair = std::clamp<std::size_t>(std::min(rays_of_a_short_round, rays_.size()) / waiting, 1, most_trials_a_pair);
    const std::size_t rays = waiting * per_pair;
    const uint waiting_now = static_cast<uint>(waiting), each = static_cast<uint>(per_pair);
    propose_trials_(rays, subpaths.key, rules_, radius, waiting_now, each, waiting_, pairs.pairs,
                    subpaths.camera_subpaths.vertices, subpaths.light_subpaths.vertices(), states_, rays_, trials_made_);
    ray_count_.fill(static_cast<uint>(rays));
    trace_closest_(rays, scene.geometry(), rays_, hits_, pairs.all(), ray_count_);
    trials_ += rays;
    judge_trials_(waiting, radius, waiting_now, each, waiting_, pairs.pairs, subpaths.light_subpaths.vertices(), rays_, hits_, trials_made_,
                  states_, flags_);
    compaction_.keep(waiting_, flags_, waiting_count_, waiting, PATH_ALIVE, next_waiting_, next_waiting_count_);
    std::swap(waiting_, next_waiting_);
    std::swap(waiting_count_, next_waiting_count_);
    return waiting_count_.read(0);
}

} // namespace sundog
