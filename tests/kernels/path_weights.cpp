// Weights by recursion are those of the balance heuristic, written out: for random paths with random densities, and every way to
// make each, the device's own weights against density over sum of densities in double precision.
#include "device/kernel.h"
#include "shared/bidirectional.h"
#include "support/device_fixture.h"

#include <numbers>
#include <random>

namespace sundog
{
namespace
{

constexpr int max_edges = 9;

// Of a vertex of a path from the camera (0) to the light (`edges`). The edge to the next vertex has length 1 / sqrt(inverse_square).
struct VertexDensities {
    float pdf_to_light = 0, pdf_to_camera = 0; // of scattering, 1/sr; 0 at both: specular
    float cos_to_light = 0, cos_to_camera = 0;
    float distance_squared = 0; // of the edge to the next vertex
};

struct PathDensities {
    int edges = 0;
    float camera_pdf_a = 0; // across the first edge, at vertex 1
    float light_pdf = 0, ray_pdf = 0, connect_pdf = 0;
    std::vector<VertexDensities> vertices; // 0 .. edges
    bool specular(int vertex) const { return vertices[static_cast<std::size_t>(vertex)].pdf_to_light == 0; }
};

// Techniques by number: 0 .. edges - 2: connect (or, from vertex 0, splat) vertex i and i + 1; edges - 1: next-event estimation;
// edges: hit; edges + i: merge at vertex i (1 .. edges - 1). Weights of those that do not exist are 0.
std::size_t technique_count(int edges)
{
    return static_cast<std::size_t>(2 * edges);
}

// What the density of a technique is times: of one that merges, and of the others.
struct Measure {
    double merging = 0.0, others = 1.0;
};

// A merge accepts the light subpath's end with probability pi r^2 p, for each light subpath [Georgiev et al. 2012].
Measure vertex_merging(Techniques techniques)
{
    return {techniques.merge, 1.0};
}

// A merge makes a path of one vertex more, and any other technique adds that vertex by perturbing one, with density
// 1 / (pi r^2) [Hachisuka, Pantaleoni and Jensen 2012].
Measure unified_path_sampling(Techniques techniques)
{
    return {techniques.light_paths, techniques.light_paths / techniques.merge};
}

std::vector<double> balance_weights(const PathDensities& path, Techniques techniques, Measure measure)
{
    const int k = path.edges;
    const auto& v = path.vertices;
    const auto at = [&](int i) -> const VertexDensities& { return v[static_cast<std::size_t>(i)]; };
    // Area densities of each vertex from either side; scattering at specular vertices counts as 1 both ways.
    std::vector<double> camera(static_cast<std::size_t>(k) + 1, 1.0), light(static_cast<std::size_t>(k) + 1, 1.0);
    camera[1] = double(path.camera_pdf_a) * at(1).cos_to_camera;
    for (int i = 2; i <= k; i++)
        camera[static_cast<std::size_t>(i)] =
            (path.specular(i - 1) ? 1.0 : double(at(i - 1).pdf_to_light)) * at(i).cos_to_camera / at(i - 1).distance_squared;
    light[static_cast<std::size_t>(k)] = path.light_pdf;
    light[static_cast<std::size_t>(k - 1)] = double(path.ray_pdf) * at(k - 1).cos_to_light / at(k - 1).distance_squared;
    for (int i = k - 2; i >= 1; i--)
        light[static_cast<std::size_t>(i)] =
            (path.specular(i + 1) ? 1.0 : double(at(i + 1).pdf_to_camera)) * at(i).cos_to_light / at(i).distance_squared;
    const auto product = [](const std::vector<double>& p, int from, int to) {
        double result = 1.0;
        for (int i = from; i <= to; i++) result *= p[static_cast<std::size_t>(i)];
        return result;
    };
    std::vector<double> density(technique_count(k), 0.0);
    if (techniques.connect > 0) {
        if (!path.specular(1)) density[0] = techniques.light_paths * product(light, 1, k);
        for (int i = 1; i <= k - 2; i++)
            if (!path.specular(i) && !path.specular(i + 1))
                density[static_cast<std::size_t>(i)] = product(camera, 1, i) * product(light, i + 1, k);
        if (!path.specular(k - 1)) density[static_cast<std::size_t>(k - 1)] = product(camera, 1, k - 1) * path.connect_pdf;
    }
    density[static_cast<std::size_t>(k)] = product(camera, 1, k);
    // Gathered photons take the place of what the vertex before them has found, so that one must be there to connect to them.
    const bool gathered = techniques.merge_unconnected < techniques.merge;
    for (int i = gathered ? 2 : 1; i <= k - 1; i++)
        if (!path.specular(i) && !(gathered && path.specular(i - 1)))
            density[static_cast<std::size_t>(k + i)] = product(camera, 1, i) * product(light, i, k) * measure.merging;
    for (int t = 0; t <= k; t++) density[static_cast<std::size_t>(t)] *= measure.others;
    double sum = 0.0;
    for (double d : density) sum += d;
    for (double& d : density) d /= sum;
    return density;
}

// One path a work-item. densities: edges, camera, light, ray and connect density, and then five numbers a vertex.
constexpr const char* weigh_paths = R"(
#include "scene/path_weights.h"
#define MAX_EDGES 9
#define AT(i, field) v[5 * (i) + (field)]
__kernel void weigh_paths(uint count, Techniques techniques, __global const float* densities, __global float* weights)
{
    const uint index = get_global_id(0);
    if (index >= count) return;
    __global const float* p = densities + index * (5 + 5 * (MAX_EDGES + 1));
    __global const float* v = p + 5;
    __global float* w = weights + index * 2 * MAX_EDGES;
    const int k = (int)p[0];
    PathWeights camera[MAX_EDGES + 1], light[MAX_EDGES + 1];
    const PathWeights first = {techniques.connect * techniques.light_paths / p[1], 0.0f, 0.0f, 0.0f};
    camera[1] = weights_at_vertex(first, 1.0f, AT(1, 3));
    Techniques at[MAX_EDGES + 1];
    for (int i = 1; i < k; ++i) {
        at[i] = techniques_at(techniques, i > 1 && AT(i - 1, 0) > 0.0f);
        camera[i + 1] = weights_at_vertex(weights_after_scattering(camera[i], at[i], AT(i, 0), AT(i, 1), AT(i, 2)), AT(i, 4), AT(i + 1, 3));
    }
    const float emitted = AT(k, 3) / (p[2] * p[3]);
    PathWeights start = {techniques.connect / p[3], emitted, emitted * techniques.inverse_merge, emitted};
    light[k - 1] = weights_at_vertex(start, AT(k - 1, 4), AT(k - 1, 2));
    light[k - 1].vcm *= p[4] / p[2];
    for (int i = k - 1; i > 1; --i)
        light[i - 1] = weights_at_vertex(weights_after_scattering(light[i], techniques, AT(i, 1), AT(i, 0), AT(i, 3)), AT(i - 1, 4), AT(i - 1, 2));
    for (int i = 0; i < 2 * k; ++i) w[i] = 0.0f;
    if (techniques.connect > 0.0f) {
        if (AT(1, 0) > 0.0f)
            w[0] = joint_weight(connection_share(light[1], techniques.merge_unconnected, p[1] * AT(1, 3) / techniques.light_paths, AT(1, 0)), 0.0f);
        for (int i = 1; i <= k - 2; ++i)
            if (AT(i, 0) > 0.0f && AT(i + 1, 0) > 0.0f)
                w[i] = joint_weight(connection_share(light[i + 1], techniques.merge, AT(i, 0) * AT(i + 1, 3) / AT(i, 4), AT(i + 1, 0)),
                                    connection_share(camera[i], at[i].merge, AT(i + 1, 1) * AT(i, 2) / AT(i, 4), AT(i, 1)));
        const int c = k - 1;
        if (AT(c, 0) > 0.0f) {
            const float camera_pdf_a = AT(c, 0) * AT(k, 3) / AT(c, 4);
            w[c] = joint_weight(camera_pdf_a / p[4], connection_share(camera[c], at[c].merge, p[2] / p[4] * p[3] * AT(c, 2) / AT(c, 4), AT(c, 1)));
        }
    }
    w[k] = hit_weight(camera[k], p[4], p[2] * p[3]);
    if (GATHERED) {
        for (int i = 2; i <= k - 1; ++i) // as connecting the vertices i - 1 and i, times the ratio of the two densities
            w[k + i] = w[i - 1] * techniques.merge * AT(i - 1, 0) * AT(i, 3) / AT(i - 1, 4);
        return;
    }
    for (int i = 1; i <= k - 1; ++i)
        if (AT(i, 0) > 0.0f && techniques.merge > 0.0f)
            w[k + i] = joint_weight(merge_share(light[i].vcm, light[i].vm, techniques, AT(i, 0)), merge_share(camera[i].vcm, camera[i].vm, techniques, AT(i, 1)));
}
)";

class PathWeightsOnDevice : public DeviceFixture
{
protected:
    // Long enough to have specular vertices in rows; densities over four decades.
    static PathDensities random_path(std::mt19937& random)
    {
        const auto between = [&](double low, double high) {
            return static_cast<float>(low * std::pow(high / low, std::uniform_real_distribution<>(0, 1)(random)));
        };
        PathDensities path;
        path.edges = std::uniform_int_distribution<>(2, max_edges)(random);
        path.camera_pdf_a = between(1, 1e4);
        path.light_pdf = between(.01, 10);
        path.ray_pdf = between(.1, 1);
        path.connect_pdf = between(.01, 10);
        for (int i = 0; i <= path.edges; i++) {
            VertexDensities v{between(.01, 100), between(.01, 100), between(.05, 1), between(.05, 1), between(.1, 10)};
            if (i > 0 && i < path.edges && random() % 3 == 0) v.pdf_to_light = v.pdf_to_camera = 0;
            path.vertices.push_back(v);
        }
        return path;
    }

    std::vector<std::vector<double>> device_weights(const std::vector<PathDensities>& paths, Techniques techniques)
    {
        const std::size_t stride = 5 + 5 * (max_edges + 1);
        std::vector<float> densities(paths.size() * stride, 0.0f);
        for (std::size_t n = 0; n < paths.size(); n++) {
            float* p = densities.data() + n * stride;
            const PathDensities& path = paths[n];
            for (float value : {static_cast<float>(path.edges), path.camera_pdf_a, path.light_pdf, path.ray_pdf, path.connect_pdf})
                *p++ = value;
            for (const auto& v : path.vertices)
                for (float value : {v.pdf_to_light, v.pdf_to_camera, v.cos_to_light, v.cos_to_camera, v.distance_squared}) *p++ = value;
        }
        Buffer<float> weights(device_, paths.size() * 2 * max_edges, "weights");
        const Kernel kernel = Kernel::from_source(device_, "weigh_paths", "Weigh paths", weigh_paths, {{{"GATHERED", techniques.merge_unconnected < techniques.merge ? "1" : "0"}}, {}});
        kernel(paths.size(), static_cast<uint>(paths.size()), techniques, Buffer<float>(device_, densities, "densities"), weights);
        const std::vector<float> all = weights.download();
        std::vector<std::vector<double>> result;
        for (std::size_t n = 0; n < paths.size(); n++) {
            const auto first = all.begin() + static_cast<std::ptrdiff_t>(n * 2 * max_edges);
            result.emplace_back(first, first + static_cast<std::ptrdiff_t>(technique_count(paths[n].edges)));
        }
        return result;
    }

    void expect_balance(Techniques techniques, Measure measure)
    {
        std::mt19937 random(7);
        std::vector<PathDensities> paths;
        for (int n = 0; n < 2000; n++) paths.push_back(random_path(random));
        const auto weights = device_weights(paths, techniques);
        for (std::size_t n = 0; n < paths.size(); n++) {
            const std::vector<double> expected = balance_weights(paths[n], techniques, measure);
            double sum = 0.0;
            for (std::size_t t = 0; t < expected.size(); t++) {
                // Some hundred products and sums of positive numbers, each rounded to 2^-24.
                EXPECT_NEAR(weights[n][t], expected[t], 2e-5 * expected[t] + 1e-12)
                    << "path " << n << " of " << paths[n].edges << " edges, technique " << t;
                sum += weights[n][t];
            }
            EXPECT_NEAR(sum, 1.0, 2e-5) << "path " << n;
        }
    }
};

TEST_F(PathWeightsOnDevice, AreBalancedOverConnectionsAndMerging)
{
    for (float merge : {1e-3f, 1.0f, 1e3f}) {
        const Techniques techniques = {merge, 1.0f / merge, merge, 1.0f, 1000.0f};
        expect_balance(techniques, vertex_merging(techniques));
    }
}

TEST_F(PathWeightsOnDevice, AreThoseOfUnifiedPathSampling)
{
    const Techniques techniques = {0.3f, 1.0f / 0.3f, 0.3f, 1.0f, 1000.0f};
    expect_balance(techniques, unified_path_sampling(techniques));
}

TEST_F(PathWeightsOnDevice, AreBalancedOverConnectionsAlone)
{
    const Techniques techniques = {0.0f, 0.0f, 0.0f, 1.0f, 1000.0f};
    expect_balance(techniques, vertex_merging(techniques));
}

TEST_F(PathWeightsOnDevice, AreBalancedOverMergingAlone)
{
    const Techniques techniques = {0.3f, 1.0f / 0.3f, 0.3f, 0.0f, 1000.0f};
    expect_balance(techniques, vertex_merging(techniques));
}

TEST_F(PathWeightsOnDevice, AreBalancedOverConnectionsAndGathering)
{
    for (float merge : {1e-3f, 1.0f, 1e3f}) {
        const Techniques techniques = {merge, 1.0f / merge, 0.0f, 1.0f, 1000.0f};
        expect_balance(techniques, vertex_merging(techniques));
    }
}

} // namespace
} // namespace sundog
