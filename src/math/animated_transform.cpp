#include "math/animated_transform.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

using Matrix = std::array<Double3, 3>;
using Quaternion = std::array<double, 4>;

Matrix linear_part(const Transform& t)
{
    Matrix m;
    for (std::size_t i = 0; i < 3; i++) m[i] = {t.m[i][0], t.m[i][1], t.m[i][2]};
    return m;
}

double frobenius(const Matrix& m)
{
    return std::sqrt(dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2]));
}

// Transposed inverse: cross products of rows over the determinant.
Matrix inverse_transpose(const Matrix& m)
{
    Matrix r = {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
    const double scale = 1.0 / dot(m[0], r[0]);
    for (Double3& row : r)
        for (double& v : row) v *= scale;
    return r;
}

// The orthogonal factor, by Newton's method: the mean with the inverse transpose, both scaled to the same size
// [Higham 1986, Computing the Polar Decomposition]. Quadratic; from a condition of 1e12 it takes ten steps or so.
Matrix orthogonal_factor(Matrix m)
{
    for (int step = 0; step < 60; step++) {
        const Matrix inverse = inverse_transpose(m);
        const double gamma = std::sqrt(frobenius(inverse) / frobenius(m));
        double change = 0.0;
        for (std::size_t i = 0; i < 3; i++)
            for (std::size_t j = 0; j < 3; j++) {
                const double next = 0.5 * (gamma * m[i][j] + inverse[i][j] / gamma);
                change = std::max(change, std::abs(next - m[i][j]));
                m[i][j] = next;
            }
        if (change < 1e-15) break;
    }
    return m;
}

// [Shepperd 1978]: from the largest of the four components, so that nothing cancels.
Quaternion to_quaternion(const Matrix& r)
{
    const double trace = r[0][0] + r[1][1] + r[2][2];
    std::size_t largest = 3;
    double most = trace;
    for (std::size_t i = 0; i < 3; i++)
        if (r[i][i] > most) {
            most = r[i][i];
            largest = i;
        }
    Quaternion q;
    if (largest == 3) {
        q = {r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1], 1.0 + trace};
    } else {
        const std::size_t i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
        q[j] = r[i][j] + r[j][i];
        q[k] = r[i][k] + r[k][i];
        q[3] = r[k][j] - r[j][k];
    }
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& v : q) v /= length;
    return q;
}

Matrix to_matrix(const Quaternion& q)
{
    const auto [x, y, z, w] = q;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

double dot4(const Quaternion& a, const Quaternion& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

// Of two unit quaternions in the same half of their sphere; exact to rounding for small angles too.
double arc(const Quaternion& a, const Quaternion& b)
{
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < 4; i++) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        sum += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return 2.0 * std::atan2(std::sqrt(difference), std::sqrt(sum));
}

// [Shoemake 1985, Animating Rotation with Quaternion Curves], the short way.
Quaternion slerp(const Quaternion& a, Quaternion b, double share)
{
    if (dot4(a, b) < 0.0)
        for (double& v : b) v = -v;
    const double angle = arc(a, b), sine = std::sin(angle);
    const bool tiny = sine < 1e-9; // then both weights are linear to rounding
    const double weight_a = tiny ? 1.0 - share : std::sin((1.0 - share) * angle) / sine;
    const double weight_b = tiny ? share : std::sin(share * angle) / sine;
    Quaternion q;
    for (std::size_t i = 0; i < 4; i++) q[i] = weight_a * a[i] + weight_b * b[i];
    const double length = std::sqrt(dot4(q, q));
    for (double& v : q) v /= length;
    return q;
}

Double3 times(const Matrix& m, const Double3& v)
{
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

double length_of(const Double3& v)
{
    return std::sqrt(dot(v, v));
}

// Bounds in double precision.
struct DoubleBox {
    Double3 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity()};
    Double3 upper{-lower[0], -lower[1], -lower[2]};

    void extend(const Double3& p, double room)
    {
        for (std::size_t i = 0; i < 3; i++) {
            lower[i] = std::min(lower[i], p[i] - room);
            upper[i] = std::max(upper[i], p[i] + room);
        }
    }
};

float rounded(double v, float towards)
{
    const auto nearest = static_cast<float>(v);
    return (towards < 0 ? nearest > v : nearest < v) ? std::nextafter(nearest, towards) : nearest;
}

std::array<Double3, 8> corners_of(const Bounds& b)
{
    std::array<Double3, 8> corners;
    for (unsigned i = 0; i < 8; i++)
        corners[i] = {i & 1 ? b.upper.x : b.lower.x, i & 2 ? b.upper.y : b.lower.y, i & 4 ? b.upper.z : b.lower.z};
    return corners;
}

void extend(DoubleBox& box, const Transform& t, const std::array<Double3, 8>& corners, double room)
{
    const Matrix m = linear_part(t);
    for (const Double3& corner : corners) {
        Double3 p = times(m, corner);
        for (std::size_t i = 0; i < 3; i++) p[i] += t.m[i][3];
        box.extend(p, room);
    }
}

} // namespace

AnimatedTransform::AnimatedTransform(const std::vector<TransformKey>& keys)
{
    assert(!keys.empty());
    constant_ = keys.front().transform;
    if (keys.size() == 1) return;
    keys_.reserve(keys.size());
    for (const TransformKey& key : keys) {
        assert(keys_.empty() || keys_.back().key.time < key.time);
        assert(keys_.empty() || (keys_.back().key.transform.determinant() < 0.0) == (key.transform.determinant() < 0.0));
        keys_.push_back(decompose(key));
    }
}

AnimatedTransform::Key AnimatedTransform::decompose(const TransformKey& key)
{
    const Matrix m = linear_part(key.transform);
    Matrix q = orthogonal_factor(m);
    // A reflection is one of all three axes, in P, and a rotation.
    if (key.transform.determinant() < 0.0)
        for (Double3& row : q) row = {-row[0], -row[1], -row[2]};
    Matrix p;
    for (std::size_t i = 0; i < 3; i++)
        for (std::size_t j = 0; j < 3; j++) {
            p[i][j] = 0.0;
            for (std::size_t k = 0; k < 3; k++) p[i][j] += 0.5 * (q[k][i] * m[k][j] + q[k][j] * m[k][i]); // symmetric but for rounding
        }
    return {key, to_quaternion(q), p};
}

Transform AnimatedTransform::between(const Key& a, const Key& b, double share) const
{
    const Matrix r = to_matrix(slerp(a.rotation, b.rotation, share));
    Matrix p;
    for (std::size_t i = 0; i < 3; i++)
        for (std::size_t j = 0; j < 3; j++) p[i][j] = (1.0 - share) * a.scale[i][j] + share * b.scale[i][j];
    Transform t;
    for (std::size_t i = 0; i < 3; i++) {
        for (std::size_t j = 0; j < 3; j++) t.m[i][j] = r[i][0] * p[0][j] + r[i][1] * p[1][j] + r[i][2] * p[2][j];
        t.m[i][3] = (1.0 - share) * a.key.transform.m[i][3] + share * b.key.transform.m[i][3];
    }
    return t;
}

Transform AnimatedTransform::at(double time) const
{
    if (keys_.empty()) return constant_;
    const auto after = std::find_if(keys_.begin(), keys_.end(), [&](const Key& k) { return k.key.time >= time; });
    if (after == keys_.end()) return keys_.back().key.transform;
    if (after == keys_.begin() || after->key.time == time) return after->key.transform;
    const Key& before = *(after - 1);
    if (before.key.transform.m == after->key.transform.m) return after->key.transform;
    return between(before, *after, (time - before.key.time) / (after->key.time - before.key.time));
}

bool AnimatedTransform::moves(double from, double to) const
{
    for (std::size_t i = 0; i + 1 < keys_.size(); i++)
        if (std::max(from, keys_[i].key.time) < std::min(to, keys_[i + 1].key.time) &&
            keys_[i].key.transform.m != keys_[i + 1].key.transform.m)
            return true;
    return false;
}

double AnimatedTransform::angle_after(std::size_t key) const
{
    Quaternion next = keys_[key + 1].rotation;
    if (dot4(keys_[key].rotation, next) < 0.0)
        for (double& v : next) v = -v;
    return 2.0 * arc(keys_[key].rotation, next); // quaternions turn by half the angle
}

std::optional<std::pair<double, double>> AnimatedTransform::ambiguous_turn() const
{
    for (std::size_t i = 0; i + 1 < keys_.size(); i++)
        if (std::abs(dot4(keys_[i].rotation, keys_[i + 1].rotation)) < 1e-6) return std::pair(keys_[i].key.time, keys_[i + 1].key.time);
    return {};
}

// A corner's path c(s) = T(s) + R(s) P(s) p, s being the share of the time between two keys, stays within
// h^2 / 8 max|c''| of its chord over a step h. T and P are linear and |R'| = w, |R''| = w^2 for an angle w, so that
// |c''| <= w^2 |P p| + 2 w |P' p|, where |P p| is largest at a key. All of the box is a mean of its corners at any time.
Bounds AnimatedTransform::box(const Bounds& b, double from, double to) const
{
    if (b.empty()) return {};
    constexpr double largest_turn = 0.1; // of a step (rad): the box is larger by 0.13 % of its corners' distances from the axis
    const std::array<Double3, 8> corners = corners_of(b);
    DoubleBox all;
    extend(all, at(from), corners, 0.0);
    extend(all, at(to), corners, 0.0);
    for (std::size_t i = 0; i + 1 < keys_.size(); i++) {
        const Key &a = keys_[i], &z = keys_[i + 1];
        const double start = std::max(from, a.key.time), end = std::min(to, z.key.time);
        if (!(start < end)) continue;
        const double angle = angle_after(i), share = (end - start) / (z.key.time - a.key.time);
        const int steps = std::max(1, static_cast<int>(std::ceil(angle * share / largest_turn)));
        double bend = 0.0;
        for (const Double3& corner : corners) {
            const Double3 first = times(a.scale, corner), last = times(z.scale, corner);
            const double growth = length_of({last[0] - first[0], last[1] - first[1], last[2] - first[2]});
            bend = std::max(bend, angle * angle * std::max(length_of(first), length_of(last)) + 2.0 * angle * growth);
        }
        const double step = share / steps;
        for (int k = 0; k <= steps; k++) extend(all, at(start + (end - start) * k / steps), corners, step * step / 8.0 * bend);
    }
    Bounds result;
    const auto down = [](double v) { return rounded(v, -std::numeric_limits<float>::infinity()); };
    const auto up = [](double v) { return rounded(v, std::numeric_limits<float>::infinity()); };
    result.lower = {down(all.lower[0]), down(all.lower[1]), down(all.lower[2])};
    result.upper = {up(all.upper[0]), up(all.upper[1]), up(all.upper[2])};
    return result;
}

// P is a mean of two that are positive (or, reflecting, negative) definite: its largest eigenvalue is no larger than
// those of both, its smallest no smaller.
double AnimatedTransform::stretch() const
{
    double largest = 0.0;
    for (const Key& key : keys_) largest = std::max(largest, frobenius(key.scale));
    return largest;
}

double AnimatedTransform::inverse_stretch() const
{
    double largest = 0.0;
    for (const Key& key : keys_) largest = std::max(largest, frobenius(inverse_transpose(key.scale)));
    return largest;
}

// T alone knows of the origin, and is linear between keys.
AnimatedTransform AnimatedTransform::relative_to(const Double3& origin) const
{
    if (is_constant()) return constant_.relative_to(origin);
    AnimatedTransform moved = *this;
    for (Key& key : moved.keys_) key.key.transform = key.key.transform.relative_to(origin);
    return moved;
}

std::vector<TransformKey> AnimatedTransform::keys() const
{
    if (keys_.empty()) return {{0.0, constant_}};
    std::vector<TransformKey> keys;
    for (const Key& key : keys_) keys.push_back(key.key);
    return keys;
}

} // namespace sundog
