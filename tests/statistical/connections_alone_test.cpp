// A connection of two vertices is an estimator by itself: without weights, for one length of path and one share of it for either
// side, it finds all light that comes by paths of that length.

#include "scene/flat_scene.h"
#include "stages/vertex_connections.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

constexpr int replicates = 12;
constexpr int size = 32;
constexpr SamplerKind sampler = SamplerKind::independent;

// Weights of 0 for all other techniques leave 1 for the connection.
constexpr const char* drop_other_techniques = R"(
#include "shared/bidirectional.h"
__kernel void drop_other_techniques(uint count, __global PathVertex* restrict vertices)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    const PathWeights none = {0.0f, 0.0f, 0.0f, 0.0f};
    vertices[index].weights = none;
    vertices[index].merge = 0.0f;
}
)";

class Connections
{
public:
    // Connects camera vertices at so many edges from the camera in paths of up to max_depth edges.
    Connections(const Scene& scene, uint camera_edges, uint max_depth)
        : scene_(shared_device(), scene), camera_(make_camera(scene.sensor, scene.film)), camera_edges_(camera_edges),
          camera_paths_(shared_device(), camera_, make_pixel_filter(scene.film.filter), sampler, scene_.surface_options()),
          light_(shared_device(), scene_, camera_, {camera_paths_.count(), camera_paths_.count(), {max_depth, 2}, sampler, true, false}),
          subpaths_(shared_device(), scene_, camera_, camera_paths_.count(), {max_depth, 2}, sampler, true, false),
          pool_(shared_device(), scene_, camera_paths_.count()),
          connections_(shared_device(), scene_, camera_paths_.count(), {max_depth, 2}, make_own_connections(shared_device(), camera_paths_.count(), sampler)),
          drop_(Kernel::from_source(shared_device(), "drop_other_techniques", "Drop", drop_other_techniques)),
          brought_(shared_device(), camera_paths_.count(), "connected radiance")
    {
    }

    double mean(std::uint64_t seed, std::uint64_t iterations)
    {
        double sum = 0.0;
        for (std::uint64_t i = 0; i < iterations; i++) sum += pass(sampler_key(seed, i)) / static_cast<double>(iterations);
        return sum;
    }

private:
    double pass(SamplerKey key)
    {
        const Techniques techniques = {0.0f, 0.0f, 0.0f, 1.0f, static_cast<float>(camera_paths_.count())};
        light_.trace(scene_, camera_paths_, pool_, key, techniques);
        drop_(light_.slots(), static_cast<uint>(light_.slots()), light_.vertices());
        brought_.upload(std::vector<Vec3>(camera_paths_.count(), Vec3{0, 0, 0}));
        camera_paths_.start(scene_, pool_, key);
        for (uint edges = 1; edges <= camera_edges_; edges++) {
            subpaths_.shade(scene_, camera_paths_, pool_, key, techniques, {});
            if (edges == camera_edges_) {
                drop_(camera_paths_.count(), static_cast<uint>(camera_paths_.count()), subpaths_.vertices);
                connections_.connect(scene_, {pool_, subpaths_, light_, key}, brought_);
            }
            if (!pool_.keep_alive()) break;
            pool_.trace(scene_);
        }
        double sum = 0.0;
        for (const Vec3& value : brought_.download()) sum += double(value.x + value.y + value.z) / 3.0;
        return sum / static_cast<double>(camera_paths_.count());
    }

    DeviceScene scene_;
    Camera camera_;
    uint camera_edges_;
    CameraPaths camera_paths_;
    LightSubpaths light_;
    CameraSubpaths subpaths_;
    PathPool pool_;
    VertexConnections connections_;
    Kernel drop_;
    Buffer<Vec3> brought_;
};

Estimate connected(const Scene& scene, uint camera_edges, uint max_depth)
{
    Connections connections(scene, camera_edges, max_depth);
    std::vector<double> means;
    for (int seed = 1; seed <= replicates; seed++) means.push_back(connections.mean(static_cast<std::uint64_t>(seed), sampled(48)));
    return estimate_from(means);
}

// Light by paths of `first` to `last` edges: what longer paths add to shorter ones of the same random numbers.
Estimate light_of_lengths(const Scene& scene, int first, int last)
{
    const auto up_to = [&](int edges, int seed) {
        const RenderRequest request{"path", 64, {{"sampler", "independent"}, {"max_depth", std::to_string(edges)}}};
        return image_mean(render_sampled(scene, request, seed));
    };
    std::vector<double> added;
    for (int seed = 1; seed <= replicates; seed++) added.push_back(up_to(last, seed) - up_to(first - 1, seed));
    return estimate_from(added);
}

struct Strategy {
    uint camera_edges;
    int first_length, last_length; // edges; the light subpath has what the connection leaves
};

TEST(ConnectionsAlone, FindAllLightOfTheirLengths)
{
    Scene scene = cornell_box(size);
    const uint rough = add_bsdf(scene, ConductorBsdf{{.2f, .9f, 1.1f}, {3.9f, 2.5f, 2.1f}, {}, Roughness{false, .4f, .4f}});
    scene.shapes.push_back(make_sphere({.3f, -.5f, .2f}, .5f, rough));
    // One vertex of either side; one of the light's and two of the camera's (whose shorter paths end before); one of the camera's and
    // one or two of the light's.
    for (const Strategy& strategy : {Strategy{1, 3, 3}, Strategy{2, 4, 4}, Strategy{1, 3, 4}}) {
        const Estimate alone = connected(scene, strategy.camera_edges, static_cast<uint>(strategy.last_length));
        const Estimate expected = light_of_lengths(scene, strategy.first_length, strategy.last_length);
        const double error = std::hypot(alone.standard_error, expected.standard_error);
        EXPECT_NEAR(alone.mean, expected.mean, student_quantile(replicates - 1, 0.005 / 3) * error)
            << strategy.camera_edges << " of " << strategy.last_length;
        EXPECT_LT(error, 0.03 * allowed_noise() * expected.mean) << strategy.camera_edges << " of " << strategy.last_length;
    }
}

} // namespace
