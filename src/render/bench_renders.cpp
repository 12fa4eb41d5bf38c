#include "render/bench_renders.h"

#include "base/timer.h"
#include "device/profile.h"
#include "render/session.h"

#include <limits>

namespace sundog {

namespace {

ShapeDescription quad(Vec3 corner, Vec3 edge_a, Vec3 edge_b, uint bsdf)
{
    TriangleMesh mesh;
    mesh.positions = {corner, corner + edge_a, corner + edge_a + edge_b, corner + edge_b};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    ShapeDescription shape;
    shape.geometry = std::move(mesh);
    shape.bsdf = bsdf;
    return shape;
}

ShapeDescription sphere(Vec3 center, float radius, uint bsdf)
{
    ShapeDescription shape;
    shape.geometry = Sphere{center, radius, false};
    shape.bsdf = bsdf;
    return shape;
}

} // namespace

Scene cornell_glass_scene(int width, int height, BenchFloor floor)
{
    enum : uint { white, red, green, glass, mirror, polished };
    Scene scene;
    scene.file = "cornell-glass";
    scene.bsdfs = {{"white", {}, DiffuseBsdf{{0.76f, 0.75f, 0.72f}}},
                   {"red", {}, DiffuseBsdf{{0.63f, 0.065f, 0.05f}}},
                   {"green", {}, DiffuseBsdf{{0.14f, 0.45f, 0.091f}}},
                   {"glass", {}, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}}},
                   {"mirror", {}, ConductorBsdf{}}};
    if (floor == BenchFloor::glossy) scene.bsdfs.push_back({"polished", {}, PhongBsdf{{0.1f, 0.1f, 0.1f}, {0.7f, 0.7f, 0.7f}, 90.0f}});
    scene.shapes = {quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, floor == BenchFloor::glossy ? polished : white), quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, white),
                    quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, white), quad({-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, red),
                    quad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, green),  quad({-.25f, .995f, -.25f}, {.5f, 0, 0}, {0, 0, .5f}, white),
                    sphere({.42f, -.6f, .32f}, .4f, glass),          sphere({-.45f, -.6f, -.3f}, .4f, mirror)};
    scene.shapes[5].emitter = AreaEmitter{{18, 15.5f, 11}};
    scene.sensor.position = {0, 0, 3.9f};
    scene.sensor.axis_x = {-1, 0, 0};
    scene.sensor.axis_y = {0, 1, 0};
    scene.sensor.axis_z = {0, 0, -1};
    scene.sensor.fov_x = 0.68f;
    scene.film.width = scene.film.crop_width = width;
    scene.film.height = scene.film.crop_height = height;
    return scene;
}

RenderFigures bench_render(Device& device, const Scene& scene, const std::string& method, std::uint64_t photons, int max_depth, int iterations)
{
    RenderFigures figures;
    const Timer setup;
    RenderSettings settings;
    settings.method = method;
    settings.parameters = {{"max_depth", std::to_string(max_depth)}};
    if (method != "path") settings.parameters["photons"] = std::to_string(photons);
    RenderSession session(scene, device, settings);
    session.iterate();
    figures.setup_seconds = setup.seconds();
    figures.kernel_seconds = device.profile().build_seconds();
    session.iterate(); // memory is touched, programs are in place

    device.profile().reset();
    const Timer timer;
    for (int i = 0; i < iterations; i++) session.iterate();
    const double wall = timer.seconds();
    double kernels = 0.0;
    if (!device.profile().tells_seconds()) kernels = std::numeric_limits<double>::quiet_NaN(); // not known
    for (const StageTime& stage : device.profile().stages()) kernels += stage.seconds;
    figures.iterations_per_second = iterations / wall;
    figures.host_share = 1.0 - kernels / wall;
    figures.peak_bytes = static_cast<double>(device.peak_bytes());
    return figures;
}

} // namespace sundog
