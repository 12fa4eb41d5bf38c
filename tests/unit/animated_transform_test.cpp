// Transforms between keys against analytic values, and bounds of what they move.
#include "math/animated_transform.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace sundog
{
namespace
{

void expect_same(const Transform& a, const Transform& b, double tolerance = 1e-12)
{
    for (std::size_t i = 0; i < 4; i++)
        for (std::size_t j = 0; j < 4; j++) EXPECT_NEAR(a.m[i][j], b.m[i][j], tolerance) << "row " << i << ", column " << j;
}

Transform moved(const Transform& rotation, Double3 to, Double3 scale = {1, 1, 1})
{
    return Transform::translate(to) * rotation * Transform::scale(scale);
}

TEST(AnimatedTransform, HalfOfAQuarterTurnIsAnEighth)
{
    for (const Double3& axis : {Double3{0, 0, 1}, Double3{1, 0, 0}, Double3{1, -2, 3}}) {
        const AnimatedTransform turn(std::vector<TransformKey>{{0, Transform()}, {1, Transform::rotate(axis, 90)}});
        for (double share : {0.5, 0.125, 0.9}) expect_same(turn.at(share), Transform::rotate(axis, 90 * share));
    }
}

// From any rotation to any other about one axis, however far, as long as there is a shorter way.
TEST(AnimatedTransform, TurnsEvenlyAboutOneAxisTheShortWay)
{
    const Transform start = Transform::rotate({3, 1, -2}, 77);
    for (double degrees : {1e-5, 0.1, 10.0, 89.0, 130.0, 179.9}) {
        for (double sign : {1.0, -1.0}) {
            const AnimatedTransform turn(std::vector<TransformKey>{{2, start}, {6, Transform::rotate({1, 2, 1}, sign * degrees) * start}});
            for (double share : {0.25, 0.5, 0.8})
                expect_same(turn.at(2 + 4 * share), Transform::rotate({1, 2, 1}, sign * degrees * share) * start);
        }
    }
    const AnimatedTransform far(std::vector<TransformKey>{{0, Transform()}, {1, Transform::rotate({0, 1, 0}, 270)}});
    expect_same(far.at(0.5), Transform::rotate({0, 1, 0}, -45));
}

// Each on its own: the middle is halfway, half turned and of half the growth.
TEST(AnimatedTransform, TranslationRotationAndScaleApart)
{
    const Transform from = moved(Transform::rotate({0, 0, 1}, 10), {1, 2, 3}, {1, 2, 4});
    const Transform to = moved(Transform::rotate({0, 0, 1}, 70), {5, 0, 3}, {3, 2, 1});
    const AnimatedTransform motion(std::vector<TransformKey>{{0, from}, {1, to}});
    expect_same(motion.at(0.5), moved(Transform::rotate({0, 0, 1}, 40), {3, 1, 3}, {2, 2, 2.5}));
    expect_same(motion.at(0.25), moved(Transform::rotate({0, 0, 1}, 25), {2, 1.5, 3}, {1.5, 2, 3.25}));
}

// A scale along oblique axes is one of the symmetric P, which is kept whole.
TEST(AnimatedTransform, ShearIsKept)
{
    const auto oblique = [](double factor) {
        return Transform::rotate({0, 0, 1}, 30) * Transform::scale({factor, 1, 1}) * Transform::rotate({0, 0, 1}, -30);
    };
    const AnimatedTransform motion(std::vector<TransformKey>{{0, oblique(1)}, {1, oblique(3)}});
    expect_same(motion.at(0.5), oblique(2));
}

TEST(AnimatedTransform, ReflectionsStayReflections)
{
    const Transform from = Transform::scale({-1, 1, 1}), to = moved(Transform::rotate({1, 1, 0}, 60), {2, 0, 0}, {-2, 2, 2});
    const AnimatedTransform motion(std::vector<TransformKey>{{0, from}, {1, to}});
    for (double time = 0; time <= 1; time += 0.05) EXPECT_LT(motion.at(time).determinant(), -0.99) << time;
    expect_same(motion.at(0.5), moved(Transform::rotate({1, 1, 0}, 30), {1, 0, 0}, {-1.5, 1.5, 1.5}));
}

TEST(AnimatedTransform, KeysAreExactAndEndsStand)
{
    const std::vector<TransformKey> keys{{-1, moved(Transform::rotate({1, 2, 3}, 33), {0.1, 0.2, 0.3}, {1, 1.1, 0.3})},
                                         {0.5, moved(Transform::rotate({3, 2, 1}, 44), {7, 8, 9})},
                                         {0.75, moved(Transform::rotate({3, 2, 1}, 44), {7, 8, 9})},
                                         {3, Transform::translate({1, 0, 0})}};
    const AnimatedTransform motion(keys);
    for (const TransformKey& key : keys) EXPECT_EQ(motion.at(key.time).m, key.transform.m) << key.time;
    EXPECT_EQ(motion.at(-9).m, keys.front().transform.m);
    EXPECT_EQ(motion.at(9).m, keys.back().transform.m);
    EXPECT_EQ(motion.at(0.6).m, keys[1].transform.m) << "between two equal keys";
    // Close to a key it is close: no segment is off by one.
    for (const TransformKey& key : keys)
        for (double offset : {-1e-9, 1e-9}) expect_same(motion.at(key.time + offset), key.transform, 1e-7);
    EXPECT_EQ(motion.keys().size(), 4u);
    const AnimatedTransform constant(keys[0].transform);
    for (double time : {-5.0, 0.0, 7.0}) EXPECT_EQ(constant.at(time).m, keys[0].transform.m);
}

TEST(AnimatedTransform, KnowsWhenItMoves)
{
    const Transform a, b = Transform::translate({1, 0, 0});
    const AnimatedTransform motion(std::vector<TransformKey>{{0, a}, {1, b}, {2, b}, {3, a}});
    EXPECT_TRUE(motion.moves(0, 3));
    EXPECT_TRUE(motion.moves(-1, 0.1));
    EXPECT_TRUE(motion.moves(0.3, 0.4));
    EXPECT_TRUE(motion.moves(1.5, 2.5));
    EXPECT_FALSE(motion.moves(1, 2));
    EXPECT_FALSE(motion.moves(-2, 0));
    EXPECT_FALSE(motion.moves(3, 4));
    EXPECT_FALSE(motion.moves(0.5, 0.5)) << "no time";
    EXPECT_FALSE(AnimatedTransform(b).moves(-1e9, 1e9));
}

TEST(AnimatedTransform, NamesHalfTurns)
{
    const Transform half = Transform::rotate({0, 1, 0}, 180);
    const AnimatedTransform motion(
        std::vector<TransformKey>{{0, Transform()}, {1, Transform::rotate({0, 1, 0}, 179)}, {4, Transform::rotate({0, 1, 0}, 359)}});
    ASSERT_TRUE(motion.ambiguous_turn());
    EXPECT_EQ(*motion.ambiguous_turn(), std::pair(1.0, 4.0));
    EXPECT_FALSE(
        AnimatedTransform(std::vector<TransformKey>{{0, Transform()}, {1, half * Transform::rotate({0, 1, 0}, 0.1)}}).ambiguous_turn());
}

struct Random {
    std::mt19937 engine{5};
    double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
    Double3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
};

bool inside(const Bounds& b, Vec3 p)
{
    return b.lower.x <= p.x && p.x <= b.upper.x && b.lower.y <= p.y && p.y <= b.upper.y && b.lower.z <= p.z && p.z <= b.upper.z;
}

// Boxes off the axis, turns of up to 180 degrees, growth and shrinking, times within, across and around the keys: corners
// are inside at every time. The boxes are no larger than what turns makes them: with steps of 0.1 rad by
// (0.1^2 / 8) (|P p| + 2 |P' p| / angle) on each side.
TEST(AnimatedTransform, BoxesHoldTheMotion)
{
    Random random;
    for (int trial = 0; trial < 300; trial++) {
        std::vector<TransformKey> keys;
        const int count = 2 + trial % 3;
        const bool mirrored = trial % 5 == 0;
        for (int k = 0; k < count; k++) {
            Double3 scale{random.between(0.2, 3), random.between(0.2, 3), random.between(0.2, 3)};
            if (mirrored) scale[0] = -scale[0];
            Transform t =
                Transform::translate(random.in_cube(trial % 4 ? 5 : 0)) * Transform::rotate(random.in_cube(1), random.between(0, 360));
            if (trial % 3)
                t = t * Transform::rotate({1, 2, 3}, 20) * Transform::scale(scale) * Transform::rotate({1, 2, 3}, -20);
            else if (mirrored)
                t = t * Transform::scale({-1, 1, 1});
            keys.push_back({k + random.between(0, 0.5), t});
        }
        const AnimatedTransform motion(keys);
        Bounds box;
        for (int corner = 0; corner < 2; corner++) {
            const Double3 p = random.in_cube(trial % 2 ? 1 : 10);
            box.extend(Vec3{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
        const double from = random.between(-0.5, count - 1), to = from + random.between(0.01, count);
        const Bounds all = motion.box(box, from, to);
        Bounds tight;
        for (int i = 0; i <= 1000; i++) {
            const Bounds now = motion.at(from + (to - from) * i / 1000).box(box);
            tight.extend(now);
            EXPECT_TRUE(inside(all, now.lower) && inside(all, now.upper)) << "trial " << trial << " at " << i;
        }
        const float size = length(tight.extent()) + length(box.lower) + length(box.upper);
        EXPECT_LT(length(all.lower - tight.lower) + length(all.upper - tight.upper), 0.02f * size) << "trial " << trial;
        EXPECT_GE(motion.stretch() * motion.inverse_stretch(), 1.0);
    }
}

// A rod of length 10 that turns by 170 degrees reaches as far as its end, also where no key has it.
TEST(AnimatedTransform, TheBoxOfATurningRod)
{
    const AnimatedTransform turn(std::vector<TransformKey>{{0, Transform()}, {1, Transform::rotate({0, 0, 1}, 170)}});
    const Bounds all = turn.box({{10, 0, 0}, {10, 0, 0}}, 0, 1);
    EXPECT_GE(all.upper.y, 10.0f);
    EXPECT_LT(all.upper.y, 10.02f);
    EXPECT_LT(all.lower.x, -9.84f);
    EXPECT_GT(all.lower.x, -9.88f);
    const AnimatedTransform slide(std::vector<TransformKey>{{0, Transform()}, {1, Transform::translate({4, 0, 0})}});
    EXPECT_EQ(slide.box({{0, 0, 0}, {1, 1, 1}}, 0, 0.5).upper.x, 3.0f) << "without a turn it is exact";
    EXPECT_TRUE(slide.box({}, 0, 1).empty());
}

} // namespace
} // namespace sundog
