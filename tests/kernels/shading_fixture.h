// Runs shading stages along real paths through a scene that has everything, and compares each vertex with plain C++.
#pragma once

#include "stages/device_scene.h"
#include "stages/sampling.h"
#include "support/device_fixture.h"
#include "support/photon_cloud.h"
#include "support/plain_paths.h"
#include "support/shading_scene.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <random>

namespace sundog
{

struct ShadingCase {
    std::string name;
    ShadingSceneOptions options;
    PathRules rules;
    bool complete = false; // long paths: all that there is must occur
};

inline std::ostream& operator<<(std::ostream& stream, const ShadingCase& shading_case)
{
    return stream << shading_case.name;
}

// Values that no stage writes, to see what it leaves alone.
constexpr uint untouched_flag = 77;
constexpr float untouched = -7.0f;
constexpr Vec3 radiance_before{0.5f, 0.25f, 0.125f};

class ShadingStage : public DeviceFixture, public testing::WithParamInterface<ShadingCase>
{
protected:
    static constexpr uint light_paths = 16'000;
    static constexpr int bounces = 5;

    // Relative error of radiometric quantities: products of some twenty rounded numbers, and cosines that Doubt lets be as
    // small as 1e-2, with absolute errors of 1e-6.
    static constexpr double colour_error = 3e-4;
    // Absolute error of points and of offsets in them, at coordinates around 2: less than a quarter of an offset (8e-6).
    static constexpr double point_error = 2e-6;
    // Of unit directions: normals at hits are as wrong as the points, over a radius of 0.3; refraction doubles that, and
    // near total reflection, as far as Doubt lets it go, there is another factor of 5.
    static constexpr double direction_error = 3e-5;

    ShadingStage() : plain_(ShadingScene(GetParam().options).scene), scene_(device_, plain_.scene, false, LightSelection::power)
    {
        use_sampler(options_, SamplerKind::independent);
    }

    const PathRules& rules() const { return GetParam().rules; }

    void reserve(std::size_t count)
    {
        rays_ = allocate<Ray>(count);
        paths_ = allocate<PathState>(count);
        hits_ = allocate<Hit>(count);
        flags_ = allocate<uint>(count);
        active_ = allocate<uint>(count);
        active_count_ = allocate<uint>(1);
        shadow_rays_ = allocate<Ray>(count);
        shadow_radiance_ = allocate<Vec3>(count);
        radiance_ = allocate<Vec3>(count);
        trace_ = Kernel(device_, "trace_closest", "Trace", scene_.trace_options());
    }

    void start_camera_paths()
    {
        const Camera& camera = plain_.camera;
        pixels_ = pixels_by_path(camera.crop_width, camera.crop_height);
        reserve(pixels_.size());
        Kernel(device_, "generate_camera_rays", "Generate", options_)(pixels_.size(), camera, upload(std::vector{plain_.filter}), key_,
                                                                      static_cast<uint>(pixels_.size()), rays_, paths_, radiance_, active_);
        leave_some_out(pixels_.size());
    }

    void start_light_paths()
    {
        reserve(light_paths);
        Kernel(device_, "emit_light_paths", "Emit", options_)(light_paths, scene_.surfaces(), key_, light_paths, rays_, paths_, active_);
        leave_some_out(light_paths);
    }

    // Shades all vertices of the paths, some bounces long: `shade` launches the stage, `check` compares the vertex of one
    // item.
    template <class Shade, class Check> void follow_paths(Shade shade, Check check)
    {
        for (int bounce = 0; bounce < bounces && !active_paths_.empty(); ++bounce) {
            SCOPED_TRACE("bounce " + std::to_string(bounce));
            trace();
            const auto rays = rays_.download();
            const auto states = paths_.download();
            const auto hits = hits_.download();
            shade(active_paths_.size());
            next_rays_ = rays_.download();
            next_paths_ = paths_.download();
            got_flags_ = flags_.download();
            got_shadow_rays_ = shadow_rays_.download();
            got_shadow_radiance_ = shadow_radiance_.download();
            got_radiance_ = radiance_.download();
            for (std::size_t item = 0; item < active_paths_.size() && !HasFailure(); ++item) {
                const uint path = active_paths_[item];
                check(item, path, PlainVertex{rays[path], hits[path], states[path]});
            }
            expect_the_rest_untouched(rays);
            if (HasFailure()) return;
            keep_alive();
        }
    }

    // Finds the hits of the active paths, after clearing what stages write.
    void trace()
    {
        const std::size_t count = rays_.size();
        active_.upload(active_paths_);
        active_count_.fill(static_cast<uint>(active_paths_.size()));
        flags_.fill(untouched_flag);
        radiance_.upload(std::vector<Vec3>(count, radiance_before));
        shadow_radiance_.upload(std::vector<Vec3>(count, {untouched, untouched, untouched}));
        shadow_rays_.upload(std::vector<Ray>(count, {{0, 0, 0}, untouched, {0, 0, 0}, 0}));
        trace_(active_paths_.size(), scene_.geometry(), rays_, hits_, active_, active_count_);
    }

    // Active paths in any order, and not all of them: items are not paths.
    void leave_some_out(std::size_t count)
    {
        activate_all(count);
        std::shuffle(active_paths_.begin(), active_paths_.end(), std::mt19937(7));
        active_paths_.resize(count - count / 10);
    }

    void activate_all(std::size_t count)
    {
        active_paths_.resize(count);
        std::iota(active_paths_.begin(), active_paths_.end(), 0u);
    }

    // Whether the item can be compared; counts what happened there.
    bool is_certain(const PlainVertex& vertex, const PlainOutcome& outcome, const Doubt& doubt)
    {
        ++seen_["vertices"];
        if (doubt) {
            ++seen_["doubtful"];
            return false;
        }
        if (vertex.missed()) ++seen_["misses"];
        if (outcome.next) {
            ++seen_["steps"];
            const double squared_index = outcome.next->eta_scale / double(vertex.path.eta_scale);
            if (std::abs(squared_index - 1.0) > 0.1) ++seen_[squared_index > 1.0 ? "entering" : "leaving"];
        }
        if (!is_black(outcome.radiance)) {
            const Light* light = outcome.surface ? plain_light_at(plain_, *outcome.surface) : plain_environment(plain_);
            ++seen_["type " + std::to_string(light->type) + (vertex.path.pdf_w > 0.0f ? " found" : " seen")];
        }
        if (outcome.leaves_record) ++seen_["records"];
        if (outcome.shadow) ++seen_["type " + std::to_string(outcome.shadow->light_type) + " asked"];
        if (!outcome.side) return true;
        static const std::map<std::size_t, std::string> models{{0, "diffuse"}, {1, "dielectric"}, {2, "conductor"}, {3, "null"}};
        const auto* glass = outcome.side->as<DielectricBsdf>();
        if (outcome.side->black())
            ++seen_["black " + models.at(outcome.side->bsdf->model.index())];
        else
            ++seen_[glass && glass->thin ? "pane" : models.at(outcome.side->bsdf->model.index())];
        if (length(outcome.surface->shading_normal - outcome.surface->geometric_normal) > 0.1) ++seen_["smooth"];
        return true;
    }

    // A dozen comparisons of numbers around 1, each too close with a probability of 2e-5; directions that graze the surface
    // or the light (some 1e-3), the edge of a spot's fall-off and the rim of a luminous sphere (1e-2 of their shares of an
    // eighth), and, where splats are chosen, a filter's bins (4e-3). The most are flat lights seen from their own plane: a
    // twentieth of the vertices that ask lie on one, and an eighth of those ask the same. In sum 0.015.
    void expect_few_in_doubt() { EXPECT_LE(seen_["doubtful"], 0.015 * seen_["vertices"]) << "of " << seen_["vertices"]; }

    void expect_seen(const std::vector<std::string>& names, double least = 30.0)
    {
        for (const auto& name : names) EXPECT_GE(seen_[name], least) << name;
    }

    // Where paths are long.
    void expect_all_surfaces_seen()
    {
        if (!GetParam().complete) return;
        expect_seen({"misses", "steps", "diffuse", "dielectric", "entering", "leaving", "conductor", "null", "pane", "black diffuse",
                     "black conductor", "smooth"});
    }

    void expect_all_lights_seen()
    {
        if (!GetParam().complete) return;
        for (uint type = LIGHT_TRIANGLE; type <= LIGHT_CONSTANT; ++type)
            if (type != LIGHT_CONSTANT || GetParam().options.constant_light) expect_seen({"type " + std::to_string(type) + " asked"});
    }

    static void expect_near(const char* what, uint path, Vec3 got, Vec3d expected, double error)
    {
        EXPECT_LE(length(Vec3d(got) - expected), error)
            << what << " of path " << path << ": got " << text(got) << ", expected " << text(expected);
    }

    static void expect_colour(const char* what, uint path, Vec3 got, Vec3d expected)
    {
        const Vec3d size(std::abs(expected.x), std::abs(expected.y), std::abs(expected.z));
        expect_near(what, path, got, expected, colour_error * largest(size));
    }

    static void expect_number(const char* what, uint path, double got, double expected, double relative_error)
    {
        EXPECT_NEAR(got, expected, relative_error * std::abs(expected)) << what << " of path " << path;
    }

    // Where the path goes on, and whether. left: flags of what it also left.
    void expect_step(std::size_t item, uint path, const std::optional<PlainStep>& expected, uint left = 0) const
    {
        ASSERT_EQ(got_flags_[item], (expected ? PATH_ALIVE : 0) | left) << "path " << path;
        if (!expected) return;
        const Ray& ray = next_rays_[path];
        const PathState& state = next_paths_[path];
        expect_near("ray origin", path, ray.origin, expected->ray.origin, point_error);
        expect_near("ray direction", path, ray.direction, expected->ray.direction, direction_error);
        EXPECT_EQ(ray.t_max, INFINITY);
        expect_colour("throughput", path, state.throughput, expected->throughput);
        expect_number("density", path, state.pdf_w, expected->pdf_w, colour_error);
        expect_number("squared indices", path, state.eta_scale, expected->eta_scale, 1e-6);
        EXPECT_EQ(state.depth, expected->depth) << "path " << path;
        EXPECT_EQ(state.scattered, expected->scattered) << "path " << path;
    }

    // A free ray's light (or splat) is `value`; without a shadow ray there must be none.
    void expect_shadow(uint path, const std::optional<PlainShadow>& expected, const Vec3* value) const
    {
        const Ray& ray = got_shadow_rays_[path];
        if (!expected) {
            ASSERT_EQ(ray.t_max, 0.0f) << "a shadow ray of path " << path << " that brings nothing";
            return;
        }
        ASSERT_GT(ray.t_max, 0.0f) << "no shadow ray of path " << path << " to light type " << expected->light_type;
        expect_near("shadow ray origin", path, ray.origin, expected->ray.origin, point_error);
        expect_near("shadow ray direction", path, ray.direction, expected->ray.direction, 2.0 * point_error);
        EXPECT_TRUE(std::abs(ray.t_max - expected->ray.t_max) < 1e-6 || ray.t_max == expected->ray.t_max) << ray.t_max;
        if (value) expect_colour("light", path, *value, expected->value);
    }

    // What the stage added.
    void expect_radiance(uint path, Vec3d added) const
    {
        const double rounded = 1e-7; // of the sum
        expect_near("radiance", path, got_radiance_[path], Vec3d(radiance_before) + added, colour_error * length(added) + rounded);
    }

    // beta rho / pi at the surface, for photons that arrive on the side seen and leave enough edges for the way to the camera.
    void expect_query(uint path, const PlainVertex& vertex, const PlainOutcome& expected, const GatherQuery& query, float radius) const
    {
        ASSERT_EQ(query.radius, expected.leaves_record ? radius : 0.0f) << "path " << path;
        if (!expected.leaves_record) return;
        expect_near("query position", path, query.position, expected.surface->position, point_error);
        expect_near("query normal", path, query.normal, expected.surface->normal_seen(), direction_error);
        const Vec3d reflectance = expected.side->as<DiffuseBsdf>()->reflectance.value;
        expect_colour("query throughput", path, query.throughput, Vec3d(vertex.path.throughput) * reflectance / pi);
        const uint edges_left = is_bounded(rules()) ? rules().max_depth - vertex.path.depth : UNBOUNDED_DEPTH;
        EXPECT_EQ(query.max_photon_depth, edges_left) << "path " << path;
        EXPECT_EQ(query.flags, 0u) << "path " << path;
    }

    // A photon, but for how it is marked. Directions and normals are packed, with the errors that frame.h promises.
    static void expect_photon(uint path, const PlainVertex& vertex, const PlainSurface& surface, Vec3d flux, const Photon& photon)
    {
        expect_near("photon", path, photon.position, surface.position, point_error);
        expect_colour("flux", path, photon.flux, flux);
        EXPECT_LT(angle_between(unpacked_direction(photon.direction), -surface.outgoing), 1e-4 + direction_error) << "path " << path;
        const double normal_error = vertex.path.depth < PHOTON_DEEP ? 1.2e-3 : 0.12;
        EXPECT_LT(angle_between(unpacked_normal(photon.normal_depth), surface.normal_seen()), normal_error + direction_error) << "path " << path;
        EXPECT_EQ(depth_of(photon), std::min(vertex.path.depth, PHOTON_DEEP + PHOTON_MOST_BEYOND)) << "path " << path;
    }

    PlainNumbers camera_numbers(uint path) const { return PlainNumbers::camera(key_, path); }
    PlainNumbers light_numbers(uint path) const { return PlainNumbers::light(key_, path, light_paths); }

    PlainScene plain_;
    DeviceScene scene_;
    BuildOptions options_;
    SamplerKey key_ = sampler_key(0x0123456789abcdef, (std::uint64_t(3) << 32) + 5);
    std::vector<std::array<int, 2>> pixels_;

    Buffer<Ray> rays_, shadow_rays_;
    Buffer<PathState> paths_;
    Buffer<Hit> hits_;
    Buffer<uint> flags_, active_, active_count_;
    Buffer<Vec3> radiance_, shadow_radiance_;

    std::vector<Ray> next_rays_, got_shadow_rays_;
    std::vector<PathState> next_paths_;
    std::vector<uint> got_flags_;
    std::vector<Vec3> got_shadow_radiance_, got_radiance_;
    std::map<std::string, double> seen_;

private:
    void expect_the_rest_untouched(const std::vector<Ray>& rays_before) const
    {
        for (std::size_t item = active_paths_.size(); item < got_flags_.size(); ++item)
            ASSERT_EQ(got_flags_[item], untouched_flag) << "beyond the active items";
        std::vector<bool> is_active(rays_before.size(), false);
        for (uint path : active_paths_) is_active[path] = true;
        for (std::size_t path = 0; path < rays_before.size(); ++path) {
            if (is_active[path]) continue;
            ASSERT_EQ(got_shadow_rays_[path].t_max, untouched) << "inactive path " << path;
            ASSERT_EQ(got_radiance_[path], radiance_before) << "inactive path " << path;
            ASSERT_TRUE(Vec3d(next_rays_[path].origin).x == Vec3d(rays_before[path].origin).x) << "inactive path " << path;
        }
    }

    void keep_alive()
    {
        std::vector<uint> alive;
        for (std::size_t item = 0; item < active_paths_.size(); ++item)
            if (got_flags_[item] & PATH_ALIVE) alive.push_back(active_paths_[item]);
        active_paths_ = std::move(alive);
    }

    static std::string text(Vec3d v) { return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z); }

    Kernel trace_;
    std::vector<uint> active_paths_;
};

// Rules at their limits, with and without what else can vary.
inline std::vector<ShadingCase> shading_cases()
{
    const ShadingSceneOptions open{.constant_light = true, .thin_lens = false, .filter = FilterKind::mitchell};
    const ShadingSceneOptions dark{.constant_light = false, .thin_lens = true, .filter = FilterKind::gaussian};
    return {{"Unbounded", open, {UNBOUNDED_DEPTH, 1000}, true},
            {"Roulette", dark, {UNBOUNDED_DEPTH, 1}, true},
            {"LateRoulette", open, {UNBOUNDED_DEPTH, 3}},
            {"NoEdges", open, {0, 1}},
            {"OneEdge", open, {1, 1}},
            {"TwoEdges", open, {2, 5}},
            {"ThreeEdges", dark, {3, 2}},
            {"FourEdges", dark, {4, 100}}};
}

inline std::string case_name(const testing::TestParamInfo<ShadingCase>& info)
{
    return info.param.name;
}

} // namespace sundog
