#include "scene/fingerprint.h"

#include "base/hash.h"

#include <span>

namespace sundog {

namespace {

template <class T> void append(Hash& hash, std::span<const T> elements)
{
    hash.append_field({reinterpret_cast<const char*>(elements.data()), elements.size_bytes()});
}

void append(Hash& hash, const AnimatedTransform& motion)
{
    const std::vector<TransformKey> keys = motion.keys();
    append(hash, std::span<const TransformKey>(keys));
}

void append(Hash& hash, const FlatScene& scene)
{
    append(hash, std::span<const AnalyticPrimitive>(scene.analytics));
#define APPEND(type, name) append(hash, std::span<const type>(scene.name));
    SURFACE_ARRAYS(APPEND)
#undef APPEND
    if (!scene.instances.empty()) { // what they are of, and where: the hierarchy follows from it
        append(hash, std::span<const Instance>(scene.instances));
        append(hash, std::span<const uint>(scene.instance_groups));
        append(hash, std::span<const PrimitiveRange>(scene.groups));
    }
    const bool moves = scene.sensor_motion || !scene.instance_motions.empty();
    if (moves) append(hash, std::span(&scene.shutter, 1));
    if (scene.sensor_motion) append(hash, *scene.sensor_motion);
    for (const InstanceMotion& motion : scene.instance_motions) {
        append(hash, std::span(&motion.instance, 1));
        append(hash, motion.to_world);
    }
    append(hash, std::span(&scene.globals, 1));
}

} // namespace

std::string light_fingerprint(const FlatScene& scene)
{
    Hash hash;
    append(hash, scene);
    return hash.hex();
}

std::string fingerprint(const FlatScene& scene, const Camera& camera, const PixelFilter& filter)
{
    Hash hash;
    append(hash, scene);
    if (scene.hides_emitters) append(hash, std::span(&scene.hidden, 1));
    append(hash, std::span(&camera, 1));
    append(hash, std::span(&filter, 1));
    return hash.hex();
}

} // namespace sundog
