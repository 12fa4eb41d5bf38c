// Scenes of many lights of every kind, at random places, for tests of how one is chosen.
#pragma once

#include "support/double3.h"
#include "support/scene_builder.h"

#include <random>

namespace sundog
{

class RandomNumbers
{
public:
    explicit RandomNumbers(uint seed) : engine_(seed) {}
    float number(float from, float to) { return from + (to - from) * static_cast<float>((static_cast<double>(engine_()) + 0.5) / 4294967296.0); }
    Vec3 point(float size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
    Vec3 direction()
    {
        for (;;) {
            const Vec3 v = point(1.0f);
            const float squared = dot(v, v);
            if (squared > 0.01f && squared < 1.0f) return normalize(v);
        }
    }

private:
    std::mt19937 engine_;
};

// `count` lights within 10 of the origin on each axis, brightnesses over three decades, turning through all types; and,
// if asked for, two from everywhere, numbered last.
inline Scene many_lights(int count, uint seed, bool distant)
{
    RandomNumbers random(seed);
    SceneBuilder builder;
    builder.shape(Sphere{{0, 0, -11}, 0.1f});
    std::vector<decltype(EmitterDescription::model)> emitters; // which the scene lists after all shapes
    for (int i = 0; i < count; ++i) {
        const Vec3 position = random.point(10.0f), direction = random.direction();
        const Frame3d frame{Vec3d(direction)};
        const Vec3 s = to_float(frame.s), t = to_float(frame.t);
        const float brightness = std::pow(10.0f, random.number(-1.5f, 1.5f)), size = random.number(0.05f, 0.5f);
        const Vec3 color = Vec3{1.0f, 0.5f, 0.25f} * brightness;
        switch (i % 7) {
        case 0: builder.light(triangle(position, position + s * size, position + t * size), color); break;
        case 1: builder.light(Sphere{position, size, false}, color); break;
        case 2: builder.light(Disk{position, s * size, t * size}, color); break;
        case 3: builder.light(Cylinder{.start = position, .radius = 0.3f * size, .length = size, .axis_x = s, .axis_y = t, .axis_z = direction}, color); break;
        case 4: emitters.emplace_back(PointEmitter{position, color}); break;
        case 5: emitters.emplace_back(SpotEmitter{position, direction, color, random.number(0.3f, 2.5f), 0.3f}); break;
        default:
            emitters.emplace_back(ProjectorEmitter{.position = position, .axis_x = s, .axis_y = t, .axis_z = direction, .half_width = 0.5f,
                                                   .half_height = 0.3f, .irradiance = color, .texture = {}});
        }
    }
    for (const auto& emitter : emitters) builder.emitter(emitter);
    if (distant) builder.emitter(DirectionalEmitter{random.direction(), {2, 2, 2}}).emitter(ConstantEmitter{{0.1f, 0.1f, 0.1f}});
    return builder.scene;
}

} // namespace sundog
