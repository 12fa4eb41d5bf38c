// The whole of the device's light transport against a renderer that shares nothing with it: a path tracer in
// plain C++ and double precision, without hierarchy, next-event estimation or multiple importance sampling.

#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <random>

using namespace sundog;
using namespace sundog::test;

namespace {

struct Vector {
    double x, y, z;
};

Vector vector(Vec3 v)
{
    return {v.x, v.y, v.z};
}
Vector operator+(Vector a, Vector b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator-(Vector a, Vector b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(Vector a, double s)
{
    return {a.x * s, a.y * s, a.z * s};
}
double inner(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector outer(Vector a, Vector b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector unit(Vector a)
{
    return a * (1.0 / std::sqrt(inner(a, a)));
}

constexpr double nearest = 1e-9; // hits closer than this are where the ray starts

struct PlainHit {
    double t = 1e30;
    Vector normal{};
    const ShapeDescription* shape = nullptr;
};

class PlainPathTracer {
public:
    PlainPathTracer(const Scene& scene, int max_depth, std::uint64_t seed) : scene_(scene), max_depth_(max_depth), random_(seed) {}

    // Green radiance through a random point of the film.
    double sample(double film_x, double film_y)
    {
        const Sensor& sensor = scene_.sensor;
        const double half = std::tan(0.5 * static_cast<double>(sensor.fov_x));
        const Vector direction = vector(sensor.axis_x) * ((1 - 2 * film_x) * half) + vector(sensor.axis_y) * ((1 - 2 * film_y) * half) + vector(sensor.axis_z);
        return trace(vector(sensor.position), unit(direction));
    }

    double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

private:
    double trace(Vector origin, Vector direction)
    {
        double radiance = 0.0, throughput = 1.0;
        for (int depth = 1; depth <= max_depth_; depth++) {
            const PlainHit hit = intersect(origin, direction);
            if (!hit.shape) break;
            const double cosine = -inner(direction, hit.normal);
            if (hit.shape->emitter && cosine > 0) radiance += throughput * static_cast<double>(hit.shape->emitter->radiance.y);
            origin = origin + direction * hit.t;
            if (!scatter(scene_.bsdfs[hit.shape->bsdf], hit.normal, cosine, direction, throughput)) break;
        }
        return radiance;
    }

    bool scatter(const BsdfDescription& bsdf, Vector normal, double cosine, Vector& direction, double& throughput)
    {
        if (const auto* diffuse = std::get_if<DiffuseBsdf>(&bsdf.model)) {
            if (cosine <= 0) return false;
            throughput *= static_cast<double>(diffuse->reflectance.value.y);
            // Cosine-weighted: a point on the unit sphere that touches the surface from above.
            const double z = 2 * uniform() - 1, phi = 2 * std::numbers::pi * uniform(), s = std::sqrt(1 - z * z);
            direction = unit(normal + Vector{s * std::cos(phi), s * std::sin(phi), z});
            return true;
        }
        if (std::holds_alternative<ConductorBsdf>(bsdf.model)) {
            if (cosine <= 0) return false;
            direction = direction + normal * (2 * cosine); // a perfect mirror: eta 0, k 1
            return true;
        }
        const auto& glass = std::get<DielectricBsdf>(bsdf.model);
        const double ior = static_cast<double>(glass.int_ior) / static_cast<double>(glass.ext_ior);
        const double eta = cosine > 0 ? 1 / ior : ior; // near over far
        const Vector n = cosine > 0 ? normal : normal * -1.0;
        const double ci = std::abs(cosine), sin2 = eta * eta * (1 - ci * ci);
        double reflectance = 1.0, ct = 0.0;
        if (sin2 < 1) {
            ct = std::sqrt(1 - sin2);
            const double s = (eta * ci - ct) / (eta * ci + ct), p = (ci - eta * ct) / (ci + eta * ct);
            reflectance = 0.5 * (s * s + p * p);
        }
        if (uniform() < reflectance) {
            direction = direction + n * (2 * ci);
        } else {
            direction = unit(direction * eta + n * (eta * ci - ct));
            throughput *= eta * eta;
        }
        return true;
    }

    PlainHit intersect(Vector origin, Vector direction) const
    {
        PlainHit hit;
        for (const ShapeDescription& shape : scene_.shapes) {
            if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry))
                for (const auto& t : mesh->triangles)
                    intersect_triangle(vector(mesh->positions[t[0]]), vector(mesh->positions[t[1]]), vector(mesh->positions[t[2]]), origin, direction, shape, hit);
            if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) intersect_sphere(*sphere, origin, direction, shape, hit);
        }
        return hit;
    }

    static void intersect_triangle(Vector a, Vector b, Vector c, Vector origin, Vector direction, const ShapeDescription& shape, PlainHit& hit)
    {
        const Vector e = b - a, f = c - a, p = outer(direction, f);
        const double determinant = inner(e, p);
        if (determinant == 0) return;
        const Vector s = origin - a, q = outer(s, e);
        const double u = inner(s, p) / determinant, v = inner(direction, q) / determinant, t = inner(f, q) / determinant;
        if (u < 0 || v < 0 || u + v > 1 || t < nearest || t >= hit.t) return;
        hit = {t, unit(outer(e, f)), &shape};
    }

    static void intersect_sphere(const Sphere& sphere, Vector origin, Vector direction, const ShapeDescription& shape, PlainHit& hit)
    {
        const Vector o = origin - vector(sphere.center);
        const double radius = static_cast<double>(sphere.radius);
        const double b = inner(o, direction), discriminant = b * b - inner(o, o) + radius * radius;
        if (discriminant < 0) return;
        for (const double t : {-b - std::sqrt(discriminant), -b + std::sqrt(discriminant)}) {
            if (t < nearest || t >= hit.t) continue;
            hit = {t, unit(o + direction * t), &shape};
            return;
        }
    }

    const Scene& scene_;
    int max_depth_;
    std::mt19937_64 random_;
};

// A box whose whole ceiling glows, so that a path without next-event estimation finds light soon enough.
Scene glowing_ceiling(int size)
{
    Scene scene = cornell_box(size);
    scene.shapes.pop_back();
    scene.shapes[1].emitter = AreaEmitter{{1.2f, 1.0f, 0.8f}};
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    const uint mirror = add_bsdf(scene, ConductorBsdf{});
    scene.shapes.push_back(make_sphere({.45f, -.6f, .3f}, .4f, glass));
    scene.shapes.push_back(make_sphere({-.45f, -.6f, -.3f}, .4f, mirror));
    return scene;
}

TEST(PlainReference, EveryMethodThatSeesGlassAgrees)
{
    constexpr int size = 16, blocks = 2, max_depth = 7, plain_samples = 200, batches = 12;
    const Scene scene = glowing_ceiling(size);
    std::vector<std::vector<double>> plain(blocks * blocks);
    for (int batch = 0; batch < batches; batch++) {
        PlainPathTracer tracer(scene, max_depth, static_cast<std::uint64_t>(batch) + 1);
        for (int by = 0; by < blocks; by++)
            for (int bx = 0; bx < blocks; bx++) {
                const int samples = static_cast<int>(sampled(plain_samples)) * size * size / (blocks * blocks);
                double sum = 0.0;
                for (int i = 0; i < samples; i++) sum += tracer.sample((bx + tracer.uniform()) / blocks, (by + tracer.uniform()) / blocks);
                plain[static_cast<std::size_t>(by * blocks + bx)].push_back(sum / samples);
            }
    }
    for (const char* method : {"path", "pppm", "sppm"}) {
        RenderRequest request{method, 64, {{"sampler", "independent"}, {"max_depth", std::to_string(max_depth)}}};
        const bool photons = request.method != "path";
        if (photons) request.parameters.insert({{"photons", "16384"}, {"radius", "0.01"}});
        std::vector<std::vector<double>> ours(blocks * blocks);
        for (int seed = 1; seed <= batches; seed++) {
            const Image image = render_sampled(scene, request, seed);
            for (int by = 0; by < blocks; by++)
                for (int bx = 0; bx < blocks; bx++) {
                    double sum = 0.0;
                    for (int y = 0; y < size / blocks; y++)
                        for (int x = 0; x < size / blocks; x++) sum += image.at(bx * size / blocks + x, by * size / blocks + y, 1);
                    ours[static_cast<std::size_t>(by * blocks + bx)].push_back(sum * blocks * blocks / (size * size));
                }
        }
        for (std::size_t block = 0; block < plain.size(); block++) {
            const Estimate a = estimate_from(plain[block]), b = estimate_from(ours[block]);
            const double error = std::hypot(a.standard_error, b.standard_error);
            // Photons at a box's edges: as derived in agreement_test.cpp.
            EXPECT_NEAR(b.mean, a.mean, student_quantile(batches - 1, 0.005 / 12) * error + (photons ? 0.005 * a.mean : 0.0)) << method << ", block " << block;
            EXPECT_LT(error, 0.03 * allowed_noise() * a.mean) << method << ", block " << block;
        }
    }
}

} // namespace
