// The modified Phong model: what it reflects is known along the normal; samples follow their density; both ways alike.
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"

namespace sundog
{
namespace
{

using std::numbers::pi;

const std::vector<double> angles = {0.0, 0.5, 1.1, 1.4};
const std::vector<float> exponents = {1.0f, 3.0f, 40.0f};

class Phong : public BsdfProbe
{
protected:
    static ProbeScene phong(float diffuse, float specular, float exponent)
    {
        return {flat_bsdf(PhongBsdf{{diffuse, diffuse, diffuse}, {specular, specular, specular}, exponent})};
    }
};

// Seen along the normal, int (n + 2) / (2 pi) cos^n cos is 1, so that the reflectances add up; elsewhere the horizon cuts
// off a part of the lobe [Lafortune and Willems 1994].
TEST_F(Phong, ReflectsWhatItSays)
{
    constexpr uint count = 40'000;
    for (const float exponent : {0.0f, 3.0f, 40.0f, 5000.0f}) {
        double last = 1.0;
        for (const double angle : angles) {
            double sum = 0.0, squares = 0.0;
            for (const BsdfDraw& s : draw(phong(0.25f, 0.5f, exponent), {direction_at(angle)}, carries_flux, count)) {
                const double w = s.absorbed() ? 0.0 : s.weight.x;
                sum += w / count, squares += w * w / count;
            }
            const double error = std::sqrt(std::max(squares - sum * sum, 0.0) / count);
            if (angle == 0.0) {
                EXPECT_NEAR(sum, 0.75, 4.5 * error + 1e-5) << exponent;
            }
            EXPECT_LT(sum, last + 4.5 * error) << exponent << " at " << angle;
            EXPECT_GT(sum, 0.25) << "the diffuse part";
            last = sum;
        }
    }
}

// f = diffuse / pi + specular (n + 2) / (2 pi) cos^n, in the mean over the choices.
TEST_F(Phong, IsTheModelInTheMean)
{
    constexpr int count = 10'000;
    // Without an exponent, or hardly any, there is an edge where the cosine to the mirrored direction is 0.
    for (const float exponent : {0.0f, 0.05f, 1.0f, 3.0f, 40.0f}) {
        for (const Vec3d i : {normalized({0.95, 0.1, 0.1}), normalized({-0.4, -0.3, 0.8}), normalized({0.5, 0.1, 0.6})}) {
            const Vec3d o = direction_at(0.5);
            double sum = 0.0, squares = 0.0;
            for (const BsdfDraw& s : evaluate(phong(0.4f, 0.3f, exponent), {o}, std::vector<Vec3d>(count, i)))
                sum += s.evaluated / count, squares += s.evaluated * s.evaluated / count;
            const double cosine = -o.x * i.x - o.y * i.y + o.z * i.z, n = static_cast<double>(exponent);
            const double model = 0.4 / pi + (cosine > 0.0 ? 0.3 * (n + 2.0) / (2.0 * pi) * std::pow(cosine, n) : 0.0);
            EXPECT_NEAR(sum, model, 4.5 * std::sqrt(std::max(squares - sum * sum, 0.0) / count) + 1e-4 * model) << n;
        }
    }
}

TEST_F(Phong, SamplesFollowTheirDensity)
{
    constexpr uint count = 60'000;
    constexpr int fine = 12;
    const DirectionGrid grid{.rows = 40, .columns = 24};
    for (const float exponent : exponents) {
        for (const double angle : angles) {
            const Vec3d o = direction_at(angle);
            std::vector<float> densities;
            for (const BsdfDraw& s : evaluate(phong(0.0f, 1.0f, exponent), {o}, grid.midpoints(fine)))
                densities.push_back(static_cast<float>(s.evaluated_pdf));
            std::vector<Vec3d> directions;
            for (const BsdfDraw& s : draw(phong(0.0f, 1.0f, exponent), {o}, carries_radiance, count)) {
                if (s.absorbed()) continue;
                directions.push_back(s.direction.z < 1e-3 ? normalized({s.direction.x, s.direction.y, 2e-3}) : s.direction);
                if (s.pdf < 1e-3 || s.direction.z < 0.01) continue;
                ASSERT_NEAR(s.evaluated_pdf / s.pdf, 1.0, 1e-3) << exponent << " from " << angle;
                ASSERT_NEAR(s.weight.x, s.evaluated * s.direction.z / s.pdf, 1e-3) << exponent << " from " << angle;
            }
            std::vector<double> observed = grid.count(directions), expected = grid.expected(densities, fine, count);
            EXPECT_TRUE(follows(observed, expected, static_cast<int>(angles.size() * exponents.size()), 1e-2))
                << exponent << " from " << angle;
        }
    }
}

TEST_F(Phong, IsReciprocal)
{
    const ProbeScene scene = phong(0.0f, 1.0f, 7.0f);
    const Vec3d a = direction_at(0.4), b = normalized({-0.6, 0.2, 0.3});
    const double forth = evaluate(scene, {a}, {b})[0].evaluated, back = evaluate(scene, {b}, {a}, carries_flux)[0].evaluated;
    EXPECT_GT(forth, 0.0);
    EXPECT_NEAR(forth, back, 1e-5 * forth);
}

} // namespace
} // namespace sundog
