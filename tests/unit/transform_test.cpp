#include "math/transform.h"

#include "unit/scene_folder.h"

namespace
{

using namespace sundog;
using sundog::testing::expect_near;

TEST(Transform, RotationTurnsCounterClockwise)
{
    const Transform quarter = Transform::rotate({0, 0, 2}, 90);
    EXPECT_EQ(quarter.point({1, 0, 0}), (Vec3{0, 1, 0}));
    EXPECT_EQ(quarter.point({0, 1, 5}), (Vec3{-1, 0, 5}));
    // 120 degrees about (1,1,1) permutes the axes.
    expect_near(Transform::rotate({1, 1, 1}, 120).vector({1, 0, 0}), {0, 1, 0}, 1e-7f);
    expect_near(Transform::rotate({1, 0, 0}, 30).vector({0, 1, 0}), {0, 0.8660254f, 0.5f}, 1e-7f);
}

TEST(Transform, ProductsApplyTheRightFactorFirst)
{
    const Transform t = Transform::translate({1, 2, 3}) * Transform::scale({2, 3, 4});
    EXPECT_EQ(t.point({1, 1, 1}), (Vec3{3, 5, 7}));
    EXPECT_EQ(t.vector({1, 1, 1}), (Vec3{2, 3, 4}));
    EXPECT_DOUBLE_EQ(t.determinant(), 24.0);
}

TEST(Transform, NormalsStayPerpendicularAndOutside)
{
    // The plane x + y = 1 under a stretch of x by 2 becomes x / 2 + y = 1.
    const Vec3 n = Transform::scale({2, 1, 1}).normal(normalize(Vec3{1, 1, 0}));
    expect_near(n, normalize(Vec3{0.5f, 1, 0}), 1e-6f);
    // A mirror at z = 0 maps the upper side of a surface to its lower side.
    expect_near(Transform::scale({1, 1, -1}).normal({0, 0, 1}), {0, 0, -1}, 0);
    expect_near(Transform::scale({-1, 1, 1}).normal({0, 0, 1}), {0, 0, 1}, 0);
}

TEST(Transform, LookAtHasMitsubasHandedness)
{
    const auto view = Transform::look_at({0, 0, 5}, {0, 0, 0}, Double3{0, 1, 0});
    ASSERT_TRUE(view);
    EXPECT_EQ(view->point({0, 0, 0}), (Vec3{0, 0, 5}));
    expect_near(view->vector({0, 0, 1}), {0, 0, -1}, 0);
    expect_near(view->vector({0, 1, 0}), {0, 1, 0}, 0);
    // Looking along -z with +y up, the right hand is at +x, so the image's left, which is camera +x, is at -x.
    expect_near(view->vector({1, 0, 0}), {-1, 0, 0}, 0);
    EXPECT_NEAR(view->determinant(), 1.0, 1e-15);

    EXPECT_FALSE(Transform::look_at({1, 2, 3}, {1, 2, 3}, Double3{0, 1, 0}));
    EXPECT_FALSE(Transform::look_at({0, 0, 0}, {0, 2, 0}, Double3{0, 1, 0}));
    EXPECT_FALSE(Transform::look_at({0, 0, 0}, {0, 2, 0}, Double3{0, 0, 0}));
    const auto free = Transform::look_at({0, 0, 0}, {0, 2, 0}, {});
    ASSERT_TRUE(free);
    EXPECT_NEAR(free->determinant(), 1.0, 1e-12);
}

TEST(Transform, UniformScaleToleratesRotationsAndReflections)
{
    const Transform turned = Transform::rotate({1, 2, 3}, 33) * Transform::scale({-2, 2, 2});
    ASSERT_TRUE(turned.uniform_scale());
    EXPECT_NEAR(*turned.uniform_scale(), 2.0, 1e-12);
    EXPECT_FALSE(Transform::scale({1, 1, 1.01}).uniform_scale());
    Transform shear;
    shear.m[0][1] = 0.1;
    EXPECT_FALSE(shear.uniform_scale());
}

TEST(Transform, SingularIsRelativeToScale)
{
    EXPECT_FALSE(Transform::scale({1e-6, 1e-6, 1e-6}).is_singular());
    EXPECT_TRUE(Transform::scale({1, 0, 1}).is_singular());
    Transform flat;
    flat.m[1] = flat.m[0];
    EXPECT_TRUE(flat.is_singular());
}

} // namespace
