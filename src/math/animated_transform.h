// Transforms that change in time, by keys between which translation, rotation and scale are interpolated.
#pragma once

#include "math/transform.h"

#include <vector>

namespace sundog
{

struct TransformKey {
    double time = 0.0; // of no unit but that of the shutter
    Transform transform;
};

// Between keys M = T R P: the translation T and the symmetric P (scale and shear) change linearly, the rotation R turns
// evenly about one axis, the short way [Shoemake and Duff 1992, Matrix Animation and Polar Decomposition]. Mitsuba 0.6
// (AnimatedTransform) keeps the diagonal of P alone, so that both agree for scales along the axes. Before the first key
// and after the last nothing moves. At a key the transform is the key's, bit for bit.
class AnimatedTransform
{
public:
    AnimatedTransform(const Transform& constant = {}) : constant_(constant) {}

    // At least one key, in ascending order of times; all affine, none singular, their determinants of one sign: what
    // turns inside out would be flat on its way.
    explicit AnimatedTransform(const std::vector<TransformKey>& keys);

    Transform at(double time) const;

    // Whether at() is not the same everywhere in [from, to].
    bool moves(double from, double to) const;

    // Whether there is a half turn between two keys, which is as short one way as the other; gives the times of the first
    // such two.
    std::optional<std::pair<double, double>> ambiguous_turn() const;

    // Around b at all times in [from, to]: exactly where nothing turns, else a little larger. Empty for an empty one.
    Bounds box(const Bounds& b, double from, double to) const;

    // By how much lengths grow at most at any time, of one that has keys: |M v| <= stretch |v|, and the same of the inverse.
    double stretch() const;
    double inverse_stretch() const;

    // As of Transform.
    AnimatedTransform relative_to(const Double3& origin) const;

    std::vector<TransformKey> keys() const; // one, of time 0, where it is constant
    bool is_constant() const { return keys_.empty(); }

private:
    using Matrix = std::array<Double3, 3>;
    using Quaternion = std::array<double, 4>; // x, y, z, w

    struct Key {
        TransformKey key;
        Quaternion rotation;
        Matrix scale; // P
    };

    static Key decompose(const TransformKey& key);
    double angle_after(std::size_t key) const; // that R turns by to the next one, in [0, pi]
    Transform between(const Key& a, const Key& b, double share) const;

    Transform constant_;    // without keys
    std::vector<Key> keys_; // at least two, or none
};

} // namespace sundog
