// How likely was a camera subpath to come near a light vertex? Trials, whose number until one succeeds has the mean 1 / P
// [Qin, Sun, Hou, Zhu, Zhou and Guo 2015, Unbiased Photon Gathering for Light Transport Simulation, ACM TOG 34(6), section 5].
#pragma once

#include "shared/trials.h"
#include "stages/connected_pairs.h"

namespace sundog
{

class BernoulliTrials
{
public:
    // capacity: pairs at a time.
    BernoulliTrials(Device& device, const DeviceScene& scene, std::size_t capacity, PathRules rules);

    // For the first `count` pairs, which came within the radius and were connected: makes trials until each that brings light has had
    // one succeed, however many that takes.
    void run(const DeviceScene& scene, const ConnectedSubpaths& subpaths, const ConnectedPairs& pairs, std::size_t count, float radius);

    const Buffer<TrialState>& states() const { return states_; } // by pair; without trials: no light
    std::uint64_t trials() const { return trials_; }             // traced so far
    void serialize(StateArchive& archive) { archive.count("trials", trials_); }

private:
    std::size_t run_round(const DeviceScene& scene, const ConnectedSubpaths& subpaths, const ConnectedPairs& pairs, std::size_t waiting,
                          float radius);

    PathRules rules_;
    Kernel begin_trials_, propose_trials_, trace_closest_, judge_trials_;
    Compaction compaction_;
    Buffer<TrialState> states_;
    Buffer<uint> flags_, waiting_, next_waiting_, waiting_count_, next_waiting_count_, ray_count_;
    Buffer<Ray> rays_;
    Buffer<Hit> hits_;
    Buffer<Trial> trials_made_;
    std::uint64_t trials_ = 0;
};

} // namespace sundog
