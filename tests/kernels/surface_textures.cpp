// Textures on the device against plain C++ in double precision: look-up, wrapping, filtering, transforms, nesting and mesh
// attributes, through real hits so that texture coordinates are tested along.
#include "math/srgb.h"
#include "stages/device_scene.h"
#include "support/device_fixture.h"
#include "support/double3.h"
#include "support/scene_builder.h"

#include <bit>
#include <cmath>
#include <random>

namespace sundog
{
namespace
{

constexpr int width = 5, height = 3;

// Halves of small integers and fractions are exact: 5 bits of exponent from 15, 10 of mantissa.
uint half_of(float value)
{
    if (value == 0.0f) return 0;
    const uint bits = std::bit_cast<uint>(value);
    return ((bits >> 23) - 127 + 15) << 10 | ((bits >> 13) & 0x3ff);
}

struct TestImage {
    std::shared_ptr<const TexelImage> image;
    std::vector<Vec3d> linear; // what each texel means
};

TestImage make_image(TexelFormat format, unsigned seed)
{
    std::mt19937 random(seed);
    TexelImage image;
    image.width = width;
    image.height = height;
    image.format = format;
    TestImage result;
    for (int i = 0; i < width * height; i++) {
        const uint r = random() % 256, g = random() % 256, b = random() % 256;
        if (format == TexelFormat::half) {
            const float values[3] = {static_cast<float>(r) / 16.0f, static_cast<float>(g), static_cast<float>(b) / 256.0f};
            image.texels.push_back(half_of(values[0]) | half_of(values[1]) << 16);
            image.texels.push_back(half_of(values[2]));
            result.linear.push_back({values[0], values[1], values[2]});
            continue;
        }
        image.texels.push_back(r | g << 8 | b << 16);
        const auto decode = [&](uint v) {
            const float fraction = static_cast<float>(v) / 255.0f;
            return static_cast<double>(format == TexelFormat::srgb8 ? linear_from_srgb(fraction) : fraction);
        };
        result.linear.push_back({decode(r), decode(g), decode(b)});
    }
    result.image = std::make_shared<const TexelImage>(std::move(image));
    return result;
}

int wrapped(int i, int size, WrapMode mode)
{
    if (mode == WrapMode::clamp) return std::clamp(i, 0, size - 1);
    const auto modulo = [](int a, int n) { return ((a % n) + n) % n; };
    if (mode == WrapMode::repeat) return modulo(i, size);
    const int j = modulo(i, 2 * size);
    return j < size ? j : 2 * size - 1 - j;
}

struct WrapModes {
    WrapMode u = WrapMode::repeat, v = WrapMode::repeat;
};

bool is_outside(int i, int size, WrapMode mode)
{
    return (mode == WrapMode::zero || mode == WrapMode::one) && (i < 0 || i >= size);
}

Vec3d constant_of(WrapMode mode)
{
    return mode == WrapMode::one ? Vec3d(1, 1, 1) : Vec3d(0, 0, 0);
}

Vec3d looked_up(const TestImage& image, WrapModes wrap, TextureFilter filter, double u, double v)
{
    const auto texel = [&](int x, int y) {
        if (is_outside(x, width, wrap.u)) return constant_of(wrap.u);
        if (is_outside(y, height, wrap.v)) return constant_of(wrap.v);
        return image.linear[static_cast<std::size_t>(wrapped(y, height, wrap.v) * width + wrapped(x, width, wrap.u))];
    };
    const double x = u * width, y = v * height;
    if (filter == TextureFilter::nearest) return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    const int x0 = static_cast<int>(std::floor(x - 0.5)), y0 = static_cast<int>(std::floor(y - 0.5));
    const double s = x - 0.5 - x0, t = y - 0.5 - y0;
    return (texel(x0, y0) * (1 - s) + texel(x0 + 1, y0) * s) * (1 - t) + (texel(x0, y0 + 1) * (1 - s) + texel(x0 + 1, y0 + 1) * s) * t;
}

class SurfaceTextures : public DeviceFixture
{
protected:
    // A mesh of two triangles with texture coordinates far outside of the unit square, and attributes; and a sphere before
    // it, so that nothing starts at index 0.
    SurfaceTextures()
    {
        builder_.shape(Sphere{{5, 5, 5}, 1.0f});
        TriangleMesh before = parallelogram({0, 0, -3}, {1, 0, 0}, {0, 1, 0});
        builder_.shape(before);
        mesh_ = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        mesh_.uvs = {{-1.3f, 2.1f}, {1.9f, 1.7f}, {2.3f, -1.6f}, {-0.9f, -0.8f}};
        mesh_.attributes = {{"vertex_color", false, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}}}, {"face_tint", true, {{0.25f, 0.5f, 0.75f}, {3, 2, 1}}}};
        builder_.shape(mesh_);
        builder_.emitter(ConstantEmitter{{1, 1, 1}});
    }

    uint add(decltype(TextureDescription::model) model, std::array<float, 3> to_u = {1, 0, 0}, std::array<float, 3> to_v = {0, 1, 0})
    {
        builder_.scene.textures.push_back({"", {}, to_u, to_v, std::move(model)});
        return static_cast<uint>(builder_.scene.textures.size() - 1);
    }

    struct Place {
        uint face;
        double b, c; // barycentric weights of the second and third vertex
        Vec2 uv;
        Vec3d color;
    };

    // The texture at random places of the mesh.
    std::vector<Place> ask(uint texture, uint count = 4000)
    {
        const DeviceScene scene(device_, builder_.scene);
        std::mt19937 random(7);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        std::vector<Hit> hits;
        const std::vector<Ray> rays(count, Ray{{0, 0, 1}, INFINITY, {0, 0, -1}, 0});
        for (uint i = 0; i < count; ++i) {
            float b = unit(random), c = unit(random);
            if (b + c > 1.0f) b = 1.0f - b, c = 1.0f - c;
            hits.push_back({1.0f, b, c, 2 + i % 2, NO_INSTANCE}); // two triangles lie before the mesh's
        }
        const Kernel kernel = test_kernel(R"(
            #include "scene/texture.h"
            __kernel void test(SURFACE_PARAMETERS, uint count, __global const Ray* rays, __global const Hit* hits, uint texture, __global float* output)
            {
                uint i = get_global_id(0);
                if (i >= count) return;
                const SurfaceView scene = SURFACE_VIEW;
                const Surface surface = surface_at(&scene, rays[i], hits[i]);
                const TexturedColor color = {{1.0f, 1.0f, 1.0f}, texture};
                vstore3(textured_color(&scene, color, &surface), 0, output + 5u * i);
                output[5u * i + 3u] = surface.uv.x;
                output[5u * i + 4u] = surface.uv.y;
            })");
        const auto output = allocate<float>(std::size_t(5) * count);
        kernel(count, scene.surfaces(), count, upload(rays), upload(hits), texture, output);
        const auto values = output.download();
        std::vector<Place> places;
        for (uint i = 0; i < count; ++i) {
            const float* v = &values[std::size_t(5) * i];
            places.push_back({i % 2, hits[i].u, hits[i].v, {v[3], v[4]}, {v[0], v[1], v[2]}});
        }
        return places;
    }

    static double tolerance(Vec3d size) { return 2e-4 * (1.0 + std::max(size.x, std::max(size.y, size.z))); }

    SceneBuilder builder_;
    TriangleMesh mesh_;
};

TEST_F(SurfaceTextures, CoordinatesAreInterpolated)
{
    for (const Place& p : ask(add(CheckerboardTexture{}))) {
        const auto& corner = mesh_.triangles[p.face];
        const Vec2 a = mesh_.uvs[corner[0]], b = mesh_.uvs[corner[1]], c = mesh_.uvs[corner[2]];
        EXPECT_NEAR(p.uv.x, a.x * (1 - p.b - p.c) + b.x * p.b + c.x * p.c, 1e-5);
        EXPECT_NEAR(p.uv.y, a.y * (1 - p.b - p.c) + b.y * p.b + c.y * p.c, 1e-5);
    }
}

TEST_F(SurfaceTextures, BitmapsAreLookedUp)
{
    for (const TexelFormat format : {TexelFormat::srgb8, TexelFormat::linear8, TexelFormat::half}) {
        const TestImage image = make_image(format, 11);
        for (const WrapModes wrap : {WrapModes{WrapMode::repeat, WrapMode::repeat}, WrapModes{WrapMode::mirror, WrapMode::mirror},
                                     WrapModes{WrapMode::clamp, WrapMode::clamp}, WrapModes{WrapMode::zero, WrapMode::zero},
                                     WrapModes{WrapMode::one, WrapMode::one}, WrapModes{WrapMode::repeat, WrapMode::clamp},
                                     WrapModes{WrapMode::zero, WrapMode::one}, WrapModes{WrapMode::one, WrapMode::mirror}}) {
            for (const TextureFilter filter : {TextureFilter::nearest, TextureFilter::bilinear}) {
                const uint texture = add(BitmapTexture{image.image, wrap.u, wrap.v, filter}, {1.5f, 0.25f, 0.1f}, {-0.5f, 2.0f, -0.3f});
                uint doubtful = 0;
                for (const Place& p : ask(texture)) {
                    const double u = 1.5 * p.uv.x + 0.25 * p.uv.y + 0.1, v = -0.5 * p.uv.x + 2.0 * p.uv.y - 0.3;
                    const auto near_edge = [](double texel) { return std::abs(texel - std::round(texel)) < 1e-4; };
                    if (filter == TextureFilter::nearest && (near_edge(u * width) || near_edge(v * height))) {
                        ++doubtful; // within rounding of the edge of a texel
                        continue;
                    }
                    const Vec3d expected = looked_up(image, wrap, filter, u, v);
                    ASSERT_LT(length(p.color - expected), tolerance(expected)) << u << " " << v;
                }
                EXPECT_LT(doubtful, 40u) << "each edge is 2e-4 texels wide";
            }
        }
    }
}

TEST_F(SurfaceTextures, CheckerboardsHoldTexturesAndFactors)
{
    const TestImage image = make_image(TexelFormat::linear8, 3);
    const uint bitmap = add(BitmapTexture{image.image, WrapMode::repeat, WrapMode::repeat, TextureFilter::nearest});
    CheckerboardTexture board;
    board.colors[0] = ColorSource(Vec3{2, 1, 0.5f}, bitmap);
    board.colors[1] = ColorSource(Vec3{0.1f, 0.2f, 0.3f});
    int first = 0, second = 0;
    for (const Place& p : ask(add(board))) {
        const auto near_edge = [](double x) { return std::abs(x - std::round(x)) < 1e-4; };
        if (near_edge(2.0 * p.uv.x) || near_edge(2.0 * p.uv.y) || near_edge(p.uv.x * width) || near_edge(p.uv.y * height)) continue;
        const auto upper = [](double x) { return x - std::floor(x) > 0.5; };
        if (upper(p.uv.x) == upper(p.uv.y)) {
            const Vec3d texel = looked_up(image, {}, TextureFilter::nearest, p.uv.x, p.uv.y);
            ASSERT_LT(length(p.color - Vec3d(2 * texel.x, texel.y, 0.5 * texel.z)), 1e-4);
            ++first;
        } else {
            ASSERT_LT(length(p.color - Vec3d(0.1, 0.2, 0.3)), 1e-6);
            ++second;
        }
    }
    EXPECT_GT(first, 1000);
    EXPECT_GT(second, 1000);
}

// With their factor, and the values of vertices too.
TEST_F(SurfaceTextures, ValuesStayInTheirRange)
{
    TexelImage image;
    image.width = image.height = 1;
    image.format = TexelFormat::float32;
    for (const float value : {-1.0f, 3.0f, 0.25f}) image.texels.push_back(std::bit_cast<uint>(value));
    const auto texel = std::make_shared<const TexelImage>(std::move(image));
    const std::pair<TextureRange, Vec3d> expected[] = {
        {TextureRange::any, {-1, 3, 0.25}}, {TextureRange::positive, {0, 3, 0.25}}, {TextureRange::unit, {0, 1, 0.25}}};
    for (const auto& [range, value] : expected) {
        const uint bitmap = add(BitmapTexture{texel});
        builder_.scene.textures[bitmap].range = range;
        for (const Place& p : ask(bitmap)) ASSERT_LT(length(p.color - value), 1e-6);
    }
    const uint tint = add(AttributeTexture{"face_tint"});
    builder_.scene.textures[tint].range = TextureRange::unit;
    for (const Place& p : ask(tint)) {
        const Vec3 value = min(mesh_.attributes[1].values[p.face], Vec3{1, 1, 1});
        ASSERT_LT(length(p.color - Vec3d(value)), 1e-5);
    }
}

TEST_F(SurfaceTextures, AttributesBelongToVerticesOrFaces)
{
    const uint by_vertex = add(AttributeTexture{"vertex_color"}), by_face = add(AttributeTexture{"face_tint"}), missing = add(AttributeTexture{"vertex_none"});
    for (const Place& p : ask(by_vertex)) {
        const auto& corner = mesh_.triangles[p.face];
        const auto& values = mesh_.attributes[0].values;
        const Vec3d expected = Vec3d(values[corner[0]]) * (1 - p.b - p.c) + Vec3d(values[corner[1]]) * p.b + Vec3d(values[corner[2]]) * p.c;
        ASSERT_LT(length(p.color - expected), 1e-5);
    }
    for (const Place& p : ask(by_face)) ASSERT_LT(length(p.color - Vec3d(mesh_.attributes[1].values[p.face])), 1e-6);
    for (const Place& p : ask(missing)) ASSERT_EQ(length(p.color), 0.0);
}

} // namespace
} // namespace sundog
