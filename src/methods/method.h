// A method: a named composition of stages. Each methods/*.cpp holds one, registers it, and says which
// paper it follows.
#pragma once

#include "film/image.h"
#include "methods/parameters.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sundog {

class Device;
class StateArchive;
struct RenderContext; // device, uploaded scene, film, camera, sampler: methods/render_context.h

// Totals since the start of the render.
struct MethodCounters {
    std::uint64_t light_subpaths = 0;
    std::uint64_t camera_subpaths = 0;
    std::uint64_t photons_stored = 0;
    std::uint64_t rays = 0;
    std::uint64_t mutations = 0; // of Markov chains
    std::uint64_t mutations_accepted = 0;
};

class Method {
public:
    virtual ~Method() = default;

    // Renders iteration `iteration` (from 0) into the film. Enqueues; need not wait.
    virtual void render_pass(std::uint64_t iteration) = 0;

    // Adds to the film's image what the method keeps outside it (the per-pixel statistics of sppm).
    virtual void resolve(Image&) const {}

    virtual MethodCounters counters() const = 0;

    // Saves or restores all that outlives an iteration and is not in the film: statistics of pixels, totals, and
    // whatever else the next iteration depends on. What is forgotten here makes a resumed render another one; a test
    // holds every registered method to it.
    virtual void serialize(StateArchive& archive) = 0;
};

// What a method tells of its error where that is asked for (film/error_estimate.h). The images of both others are means of
// what they give the film in each iteration; bias_and_variance adds the bias of each to `film.errors->bias` before.
enum class ErrorModel { none, variance, bias_and_variance };

// What a user may know of a method before choosing it.
struct MethodInfo {
    std::string name; // "sppm"
    std::string title; // "Stochastic progressive photon mapping"
    std::string paper; // "Hachisuka and Jensen 2009, ACM TOG 28(5)"
    std::string estimator_class; // "unbiased", "consistent" or "biased"
    ErrorModel error_model = ErrorModel::none;
    std::map<std::string, std::string> errors_need = {}; // parameters with which alone errors are estimated
    std::string description; // a few sentences: idea, when to use it
    std::vector<ParameterSpec> parameters;
    bool follows_motion = true; // false: what is computed in one pass is used in later ones, so nothing may move
    std::map<std::string, std::string> motion_excludes = {}; // parameters with which the method does not follow motion
    bool traces_light = true; // false: it has no paths from lights, so a collimated one stays dark
    std::unique_ptr<Method> (*create)(RenderContext&, const Parameters&) = nullptr;
};

// All registered methods, sorted by name.
std::vector<const MethodInfo*> all_methods();

// nullptr when there is none of that name.
const MethodInfo* find_method(const std::string& name);

// A static object of this type in a method's file registers it.
class MethodRegistration {
public:
    explicit MethodRegistration(MethodInfo info);
};

} // namespace sundog
