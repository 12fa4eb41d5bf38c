#include "render/bench_ray_sets.h"

#include "render/bench_meshes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <thread>

namespace sundog
{
namespace
{

constexpr int bench_width = 1024;
constexpr float infinite = std::numeric_limits<float>::infinity();

class Random
{
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    float uniform() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    float between(float a, float b) { return a + (b - a) * uniform(); }

    // Cosine-distributed about the unit normal: a point on the unit sphere around its tip.
    Vec3 diffuse_direction(Vec3 normal)
    {
        const float z = between(-1.0f, 1.0f), angle = between(0.0f, 6.2831853f), r = std::sqrt(1.0f - z * z);
        return normalize(1.0001f * normal + Vec3{r * std::cos(angle), r * std::sin(angle), z});
    }

private:
    std::mt19937 engine_;
};

// Calls work(begin, end) for pieces of [0, count) on all hardware threads.
void on_all_threads(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work)
{
    constexpr std::size_t piece = 4096;
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t begin; (begin = next.fetch_add(piece)) < count;) work(begin, std::min(begin + piece, count));
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); i++) threads.emplace_back(run);
    run();
}

RTCRay to_embree(const Ray& ray)
{
    RTCRay result{};
    result.org_x = ray.origin.x, result.org_y = ray.origin.y, result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x, result.dir_y = ray.direction.y, result.dir_z = ray.direction.z;
    result.tnear = 0.0f;
    result.tfar = ray.t_max;
    result.mask = ~0u;
    return result;
}

Ray make_ray(Vec3 origin, Vec3 direction, float t_max = infinite)
{
    return {origin, t_max, direction, 0};
}

// Where the ray hits, lifted a little off the surface, and the normal there; the lamp's middle after a miss.
struct Vertex {
    Vec3 position, normal;
};
Vertex vertex_of(const BenchScene& scene, const Ray& ray, const Hit& hit)
{
    if (hit.primitive == NO_PRIMITIVE) return {{0.0f, scene.lamp_height, 0.0f}, {0.0f, -1.0f, 0.0f}};
    const auto& [a, b, c] = scene.mesh.triangles[hit.primitive];
    const Vec3 p = scene.mesh.positions[a];
    Vec3 normal = normalize(cross(scene.mesh.positions[b] - p, scene.mesh.positions[c] - p));
    if (dot(normal, ray.direction) > 0.0f) normal = -normal;
    return {ray.origin + hit.t * ray.direction + 1e-4f * normal, normal};
}

std::vector<Ray> camera_rays(const BenchScene& scene)
{
    const Vec3 forward = normalize(scene.target - scene.eye);
    const Vec3 right = normalize(cross(forward, Vec3{0.0f, 1.0f, 0.0f})), up = cross(right, forward);
    std::vector<Ray> rays;
    const auto film = [&](int i) { return scene.tan_half_view * (2.0f * (static_cast<float>(i) + 0.5f) / bench_width - 1.0f); };
    for (int y = 0; y < bench_width; y++) {
        for (int x = 0; x < bench_width; x++) rays.push_back(make_ray(scene.eye, normalize(forward + film(x) * right - film(y) * up)));
    }
    return rays;
}

std::vector<Ray> reflect_diffusely(const BenchScene& scene, const std::vector<Ray>& rays, const EmbreeTracer& tracer, Random& random)
{
    std::vector<Hit> hits(rays.size());
    tracer.closest(rays, hits);
    std::vector<Ray> reflected;
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Vertex vertex = vertex_of(scene, rays[i], hits[i]);
        reflected.push_back(make_ray(vertex.position, random.diffuse_direction(vertex.normal)));
    }
    return reflected;
}

Vec3 lamp_point(const BenchScene& scene, Random& random)
{
    const float size = scene.lamp_half_size;
    return {random.between(-size, size), scene.lamp_height, random.between(-size, size)};
}

} // namespace

BenchScene small_bench_scene()
{
    BenchScene scene{"small", {}, {0.0f, 0.0f, 3.6f}, {0.0f, 0.0f, 0.0f}, 0.4f, 0.98f, 0.3f};
    add_box(scene.mesh, {-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 4.0f});
    add_icosphere(scene.mesh, {-0.45f, -0.6f, -0.3f}, 0.4f, 4);
    add_icosphere(scene.mesh, {0.45f, -0.6f, 0.2f}, 0.4f, 4);
    add_quad(scene.mesh, {-0.3f, 0.99f, -0.3f}, {0.3f, 0.99f, -0.3f}, {0.3f, 0.99f, 0.3f}, {-0.3f, 0.99f, 0.3f});
    return scene;
}

BenchScene large_bench_scene()
{
    BenchScene scene{"large", {}, {1.5f, 0.9f, 1.9f}, {0.0f, -0.5f, 0.0f}, 0.7f, 1.1f, 0.5f};
    add_terrain(scene.mesh, 400, 2.0f, [](float x, float z) { return -1.0f + 0.5f * fractal_noise(2.0f * x, 2.0f * z, 7); });
    Random random(7);
    for (int i = 0; i < 133; i++) {
        const Vec3 center{random.between(-1.8f, 1.8f), random.between(-0.6f, 0.8f), random.between(-1.8f, 1.8f)};
        add_icosphere(scene.mesh, center, random.between(0.05f, 0.17f), 4);
    }
    add_box(scene.mesh, {-2.01f, -1.2f, -2.01f}, {2.01f, 1.2f, 2.01f});
    return scene;
}

EmbreeTracer::EmbreeTracer(const TriangleMesh& mesh, RTCSceneFlags flags)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get()))
{
    rtcSetSceneFlags(scene_.get(), flags);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), mesh.positions.size());
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3*>(vertices));
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint), mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<std::array<uint, 3>*>(indices));
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
}

void EmbreeTracer::closest(const std::vector<Ray>& rays, std::vector<Hit>& hits) const
{
    on_all_threads(rays.size(), [&](std::size_t begin, std::size_t end) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = begin; i < end; i++) {
            RTCRayHit query{to_embree(rays[i]), {}};
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene_.get(), &context, &query);
            const bool missed = query.hit.geomID == RTC_INVALID_GEOMETRY_ID;
            hits[i] = {query.ray.tfar, query.hit.u, query.hit.v, missed ? NO_PRIMITIVE : query.hit.primID, NO_INSTANCE};
        }
    });
}

void EmbreeTracer::any(const std::vector<Ray>& rays, std::vector<uint>& occluded) const
{
    on_all_threads(rays.size(), [&](std::size_t begin, std::size_t end) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = begin; i < end; i++) {
            RTCRay query = to_embree(rays[i]);
            rtcOccluded1(scene_.get(), &context, &query);
            occluded[i] = query.tfar < 0.0f ? 1 : 0;
        }
    });
}

BenchRays bench_ray_sets(const BenchScene& scene, const EmbreeTracer& tracer)
{
    BenchRays sets;
    Random random(1);
    sets.camera = camera_rays(scene);
    sets.bounce = reflect_diffusely(scene, sets.camera, tracer, random);
    std::vector<Ray> emitted;
    for (std::size_t i = 0; i < sets.camera.size(); i++)
        emitted.push_back(make_ray(lamp_point(scene, random), random.diffuse_direction({0.0f, -1.0f, 0.0f})));
    sets.photon = reflect_diffusely(scene, emitted, tracer, random);
    for (const Ray& bounce : sets.bounce) {
        const Vec3 to_lamp = lamp_point(scene, random) - bounce.origin;
        sets.shadow.push_back(make_ray(bounce.origin, to_lamp, 0.999f));
    }
    return sets;
}

} // namespace sundog
