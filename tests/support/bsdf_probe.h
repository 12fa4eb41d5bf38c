// Asks the device's BSDF code: draws directions, and evaluates given ones.
#pragma once

#include "scene/flatten_bsdfs.h"
#include "shared/geometry.h"
#include "support/device_fixture.h"
#include "support/double3.h"

namespace sundog
{

constexpr uint carries_radiance = 0, carries_flux = 1;

struct BsdfDraw {
    Vec3d direction; // zero where the path was absorbed
    Vec3d weight;
    double pdf, eta_scale;
    double evaluated_pdf, evaluated; // bsdf_pdf_w and the red of bsdf_evaluate for the direction
    bool absorbed() const { return length(direction) == 0.0; }
};

// A surface point and the side it is seen from.
struct SurfaceSide {
    Vec3d outgoing;
    Vec3d geometric_normal{0, 0, 1};
    Vec3d shading_normal{0, 0, 1};
};

// Direction at an angle (rad) to +z, at some azimuth.
inline Vec3d direction_at(double angle)
{
    return {std::sin(angle) * std::cos(0.7), std::sin(angle) * std::sin(0.7), std::cos(angle)};
}

inline Bsdf flat_bsdf(decltype(BsdfDescription::model) model)
{
    return flatten_bsdfs({{"", {}, std::move(model)}})[0];
}

// What the BSDF code sees of a scene.
struct ProbeScene {
    ProbeScene(std::initializer_list<Bsdf> list) : bsdfs(list) {}
    ProbeScene(std::vector<Bsdf> list) : bsdfs(std::move(list)) {}
    // The last one is asked.
    explicit ProbeScene(const std::vector<decltype(BsdfDescription::model)>& models)
    {
        std::vector<BsdfDescription> descriptions;
        for (const auto& model : models) descriptions.push_back({"", {}, model});
        bsdfs = flatten_bsdfs(descriptions);
        principled = flatten_principled(descriptions);
        first = static_cast<uint>(models.size() - 1);
    }

    std::vector<Bsdf> bsdfs;
    std::vector<Principled> principled{};
    std::vector<Texture> textures{};
    std::vector<uint> texels{};
    uint first = 0;
};

class BsdfProbe : public DeviceFixture
{
protected:
    // `count` directions of the BSDF `first`; each by its own random numbers.
    std::vector<BsdfDraw> draw(const ProbeScene& scene, const SurfaceSide& side, uint carries, uint count)
    {
        return run(scene, side, carries, count, {});
    }
    std::vector<BsdfDraw> draw(ProbeScene scene, const SurfaceSide& side, uint carries, uint count, uint first)
    {
        scene.first = first;
        return run(scene, side, carries, count, {});
    }

    std::vector<BsdfDraw> evaluate(const ProbeScene& scene, const SurfaceSide& side, const std::vector<Vec3d>& directions,
                                   uint carries = carries_radiance)
    {
        std::vector<Vec3> given;
        for (Vec3d d : directions) given.push_back(to_float(d));
        return run(scene, side, carries, static_cast<uint>(given.size()), given);
    }

private:
    static constexpr std::size_t floats_per_draw = 13;

    template <class T> Buffer<T> upload_some(const std::vector<T>& data) { return upload(data.empty() ? std::vector<T>(1) : data); }

    std::vector<BsdfDraw> run(const ProbeScene& scene, const SurfaceSide& side, uint carries, uint count, const std::vector<Vec3>& given)
    {
        const auto shapes = upload(std::vector<Shape>{{scene.first, NO_LIGHT, 0, 0}});
        const auto output = allocate<float>(floats_per_draw * count);
        const auto directions = upload_some(given);
        kernel_(count, upload(scene.bsdfs), upload_some(scene.principled), upload_some(scene.textures), upload_some(scene.texels), shapes, to_float(side.outgoing), to_float(side.geometric_normal), to_float(side.shading_normal), carries, count,
                uint(given.empty() ? 0 : 1), directions, output);
        const auto values = output.download();
        std::vector<BsdfDraw> samples(count);
        for (std::size_t i = 0; i < count; ++i) {
            const float* v = &values[floats_per_draw * i];
            samples[i] = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7], v[8], v[9]};
            if (samples[i].absorbed()) continue;
            // Both at once are what each is alone; the rounding of a narrow lobe's angle grows with its density.
            EXPECT_NEAR(v[10], v[8], 1e-3 * v[8] + 1e-9) << "bsdf_densities, direction " << i;
            EXPECT_NEAR(v[11], v[12], 1e-3 * v[12] + 1e-9) << "bsdf_densities, reverse, direction " << i;
        }
        return samples;
    }

    Kernel kernel_ = test_kernel(R"(
        #include "scene/bsdf.h"
        __kernel void test(__global const Bsdf* bsdfs, __global const Principled* principled, __global const Texture* textures,
                           __global const uint* texels, __global const Shape* shapes, Vec3 outgoing, Vec3 geometric_normal, Vec3 shading_normal, uint carries,
                           uint count, uint given, __global const Vec3* directions, __global float* output)
        {
            uint i = get_global_id(0);
            if (i >= count) return;
            SurfaceView scene;
            scene.bsdfs = bsdfs;
            scene.principled = principled;
            scene.textures = textures;
            scene.texels = texels;
            scene.shapes = shapes;
            Surface surface;
            surface.position = (float3)(0.0f);
            surface.outgoing = unpack(outgoing);
            surface.geometric_normal = unpack(geometric_normal);
            surface.shading_normal = unpack(shading_normal);
            surface.offset = 0.0f;
            surface.shape = 0u;
            surface.primitive = 0u;
            surface.uv = surface.barycentric = (float2)(0.25f, 0.5f);
            surface.dpdu = (float3)(1.0f, 0.5f, 0.0f);
            surface.dpdv = (float3)(-0.5f, 1.0f, 0.0f);
            const Scattering scattering = scattering_at(&scene, &surface, random4(i, 7u).x);
            BsdfSample sample = {(float3)(0.0f), (float3)(0.0f), 0.0f, 1.0f};
            if (given) sample.direction = unpack(directions[i]);
            else if (!bsdf_sample(&scattering, &surface, random4(i, 3u + carries), (int)carries, &sample)) sample.direction = (float3)(0.0f);
            const BsdfDensities densities = bsdf_densities(&scattering, &surface, sample.direction);
            __global float* result = output + 13u * i;
            vstore3(sample.direction, 0, result);
            vstore3(sample.weight, 0, result + 3u);
            result[6] = sample.pdf_w;
            result[7] = sample.eta_scale;
            result[8] = bsdf_pdf_w(&scattering, &surface, sample.direction);
            result[9] = bsdf_evaluate(&scattering, &surface, sample.direction, (int)carries).x;
            result[10] = densities.pdf_w;
            result[11] = densities.reverse_pdf_w;
            result[12] = bsdf_reverse_pdf_w(&scattering, &surface, sample.direction);
        })");
};

} // namespace sundog
