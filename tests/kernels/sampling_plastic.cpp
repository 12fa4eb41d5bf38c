// Plastic: its two lobes add up to the model, are chosen as often as their weights say, sample what their densities say,
// and keep all light where nothing absorbs any.
#include "scene/plastic_coat.h"
#include "support/bsdf_probe.h"
#include "support/chi_squared.h"
#include "support/direction_grid.h"
#include "support/plain_bsdf.h"

namespace sundog
{
namespace
{

const std::vector<double> angles = {0.0, 0.5, 1.1, 1.45};
constexpr int tests_in_file = 2 * 2 * 4;

class Plastic : public BsdfProbe
{
protected:
    static PlasticBsdf plastic(Vec3 diffuse, Vec3 specular, std::optional<Roughness> roughness = std::nullopt, bool nonlinear = true)
    {
        PlasticBsdf bsdf;
        bsdf.int_ior = 1.5f;
        bsdf.ext_ior = 1.0f;
        bsdf.diffuse_reflectance = diffuse;
        bsdf.specular_reflectance = specular;
        bsdf.nonlinear = nonlinear;
        bsdf.roughness = roughness;
        return bsdf;
    }

    struct Mean {
        double value, error; // and its standard error
    };
    template <class Values, class Quantity> static Mean mean_of(const Values& values, Quantity quantity)
    {
        double sum = 0.0, squares = 0.0;
        for (const auto& v : values) sum += quantity(v), squares += quantity(v) * quantity(v);
        const double n = static_cast<double>(values.size()), mean = sum / n;
        return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
    }
};

double diffuse_internal_reflectance(double index)
{
    double sum = 0.0;
    constexpr int steps = 100'000;
    for (int i = 0; i < steps; ++i) sum += fresnel_reflectance(std::sqrt((i + 0.5) / steps), 1.0 / index) / steps; // over cos^2
    return sum;
}

// f = rho / (1 - rho R) (1 - F(o)) (1 - F(i)) / (pi eta^2) beside the specular direction, in the mean over the choices.
TEST_F(Plastic, SmoothBaseIsTheModel)
{
    const double internal = diffuse_internal_reflectance(1.5);
    EXPECT_NEAR(smooth_internal_reflectance(1.5), internal, 1e-5);
    for (const bool nonlinear : {false, true}) {
        const double rho = 0.4, base = rho / (1.0 - (nonlinear ? rho : 1.0) * internal);
        const std::vector<Bsdf> bsdfs = {flat_bsdf(plastic({0.4f, 0.8f, 0.1f}, {0.5f, 0.5f, 0.5f}, {}, nonlinear))};
        for (const double angle_o : angles) {
            for (const double angle_i : angles) {
                const Vec3d o = direction_at(angle_o), i = direction_at(-angle_i);
                const Mean f = mean_of(evaluate(bsdfs, {o}, std::vector<Vec3d>(10'000, i)), [](const BsdfDraw& s) { return s.evaluated; });
                const double model = base * (1.0 - fresnel_reflectance(o.z, 1.5)) * (1.0 - fresnel_reflectance(i.z, 1.5)) / (pi * 2.25);
                EXPECT_NEAR(f.value, model, 4.5 * f.error + 1e-4 * model) << angle_o << " and " << angle_i;
            }
        }
    }
}

TEST_F(Plastic, CoatIsChosenByItsShare)
{
    constexpr uint count = 20'000;
    for (const double angle : angles) {
        const double reflected = fresnel_reflectance(std::cos(angle), 1.5), coat = reflected * 0.5,
                     share = coat / (coat + (1.0 - reflected) * 0.25);
        const auto draws =
            draw({flat_bsdf(plastic({0.25f, 0.25f, 0.25f}, {0.5f, 0.5f, 0.5f}))}, {direction_at(angle)}, carries_flux, count);
        const Mean specular = mean_of(draws, [](const BsdfDraw& s) { return s.pdf == 0.0 ? 1.0 : 0.0; });
        EXPECT_NEAR(specular.value, share, 4.5 * std::sqrt(share * (1.0 - share) / count));
    }
}

// Where neither coat nor base absorbs, what the coat turns back goes to and fro until it is out: all light comes back.
TEST_F(Plastic, WhiteSmoothPlasticKeepsAllLight)
{
    const std::vector<Bsdf> bsdfs = {flat_bsdf(plastic({1, 1, 1}, {1, 1, 1}))};
    for (const double angle : angles) {
        const Mean albedo = mean_of(draw(bsdfs, {direction_at(angle)}, carries_flux, 40'000),
                                    [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
        EXPECT_NEAR(albedo.value, 1.0, 4.5 * albedo.error + 1e-4) << angle;
    }
}

struct Coat {
    bool beckmann;
    float alpha;
};
const std::vector<Coat> coats = {{false, 0.1f}, {true, 0.1f}, {false, 0.3f}, {true, 0.3f}, {false, 1.0f}, {true, 1.0f}};

// A rough coat loses what its facets send to one another, and at each of the bounces below it again. It never makes light.
TEST_F(Plastic, WhiteRoughPlasticMakesNoLight)
{
    for (const Coat& coat : coats) {
        const std::vector<Bsdf> bsdfs = {flat_bsdf(plastic({1, 1, 1}, {1, 1, 1}, Roughness{coat.beckmann, coat.alpha, coat.alpha}))};
        for (const double angle : angles) {
            const Mean albedo = mean_of(draw(bsdfs, {direction_at(angle)}, carries_flux, 20'000),
                                        [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
            EXPECT_LT(albedo.value, 1.0 + 4.5 * albedo.error + 2e-3) << angle << " on " << coat.alpha; // the series' error
        }
    }
}

// The base sends back T(o) of what the coat lets out again of diffuse light, 2 int T(mu) mu dmu, over the coat's losses.
TEST_F(Plastic, RoughBaseKeepsWhatTheCoatLetsThrough)
{
    for (const Coat& coat : coats) {
        const std::vector<Bsdf> bsdfs = {flat_bsdf(plastic({1, 1, 1}, {0, 0, 0}, Roughness{coat.beckmann, coat.alpha, coat.alpha}))};
        const CoatTransmission transmission = rough_coat(1.5, coat.alpha, coat.beckmann);
        const auto through = [&](double cosine) {
            double sum = 0.0;
            const double t = std::acos(2.0 * std::sqrt(cosine) - 1.0);
            for (std::size_t i = 0; i < transmission.series.size(); ++i)
                sum += transmission.series[i] * std::cos(static_cast<double>(i) * t);
            return sum;
        };
        double mean = 0.0;
        for (int i = 0; i < 1000; ++i) mean += through(std::sqrt((i + 0.5) / 1000)) / 1000;
        for (const double angle : angles) {
            const Mean albedo = mean_of(draw(bsdfs, {direction_at(angle)}, carries_flux, 20'000),
                                        [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
            EXPECT_NEAR(albedo.value, through(std::cos(angle)) * mean / 2.25 / (1.0 - transmission.internal_reflectance),
                        4.5 * albedo.error + 1e-3);
        }
    }
}

// The series says what light really gets through: rough glass of the same facets, asked by sampling.
TEST_F(Plastic, RoughCoatTransmitsAsRoughGlass)
{
    for (const Coat& coat : coats) {
        const Roughness roughness{coat.beckmann, coat.alpha, coat.alpha};
        const std::vector<Bsdf> glass = {flat_bsdf(DielectricBsdf{1.5f, 1.0f, false, {0, 0, 0}, {1, 1, 1}, roughness})};
        const auto series = rough_coat(1.5, coat.alpha, coat.beckmann).series;
        for (const double angle : angles) {
            const Mean passed = mean_of(draw(glass, {direction_at(angle)}, carries_flux, 40'000),
                                        [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
            const double t = std::acos(2.0 * std::sqrt(std::cos(angle)) - 1.0);
            double sum = 0.0;
            for (std::size_t i = 0; i < series.size(); ++i) sum += series[i] * std::cos(static_cast<double>(i) * t);
            EXPECT_NEAR(sum, passed.value, 4.5 * passed.error + 2e-3) << angle << " on " << coat.alpha;
        }
        // Diffuse light from within.
        double internal = 0.0, error = 0.0;
        constexpr int steps = 32;
        const std::vector<Bsdf> inside = {flat_bsdf(DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {0, 0, 0}, roughness})};
        for (int i = 0; i < steps; ++i) {
            const Mean sent_back = mean_of(draw(inside, {direction_at(pi - std::acos(std::sqrt((i + 0.5) / steps)))}, carries_flux, 10'000),
                                           [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
            internal += sent_back.value / steps;
            error += sent_back.error * sent_back.error / steps / steps;
        }
        // Evenly spaced cosines, both ends at full weight: the trapezoidal rule times 63 / 64, and half of 2 mu R at mu = 1.
        const Mean straight = mean_of(draw(inside, {direction_at(pi)}, carries_flux, 10'000),
                                      [](const BsdfDraw& s) { return s.absorbed() ? 0.0 : s.weight.x; });
        const double as_mitsuba = internal * 63.0 / 64.0 + straight.value / 64.0;
        EXPECT_NEAR(rough_coat(1.5, coat.alpha, coat.beckmann).internal_reflectance, as_mitsuba, 4.5 * std::sqrt(error) + 2e-3)
            << coat.alpha;
    }
}

// One lobe at a time, for the other is black.
TEST_F(Plastic, SamplesFollowTheirDensity)
{
    constexpr uint count = 100'000;
    const DirectionGrid grid{.rows = 32, .columns = 24};
    const std::vector<Vec3d> midpoints = grid.midpoints(12);
    for (const bool base : {false, true}) {
        for (const bool beckmann : {false, true}) {
            const Vec3 white{1, 1, 1}, black{0, 0, 0};
            const std::vector<Bsdf> bsdfs = {
                flat_bsdf(plastic(base ? white : black, base ? black : white, Roughness{beckmann, 0.5f, 0.5f}))};
            for (const double angle : angles) {
                std::vector<float> densities;
                for (const BsdfDraw& s : evaluate(bsdfs, {direction_at(angle)}, midpoints))
                    densities.push_back(static_cast<float>(s.evaluated_pdf));
                std::vector<Vec3d> directions;
                for (const BsdfDraw& s : draw(bsdfs, {direction_at(angle)}, carries_radiance, count)) {
                    if (s.absorbed()) continue;
                    // The grid measures height by the sine, which has no digits left for it next to the horizon.
                    directions.push_back(s.direction.z < 1e-3 ? normalized({s.direction.x, s.direction.y, 2e-3}) : s.direction);
                    if (s.pdf < 1e-3 || s.direction.z < 0.01) continue;
                    ASSERT_NEAR(s.evaluated_pdf / s.pdf, 1.0, 1e-2) << angle << " to " << s.direction.z;
                    ASSERT_NEAR(s.weight.x, s.evaluated * s.direction.z / s.pdf, 1e-2 * (s.weight.x + 0.1))
                        << angle << " to " << s.direction.z;
                }
                // What the coat sends below the horizon is absorbed, and no density is asked for there.
                std::vector<double> observed = grid.count(directions), expected = grid.expected(densities, 12, count);
                EXPECT_TRUE(follows(observed, expected, tests_in_file, 2e-2)) << (base ? "base" : "coat") << " from " << angle;
            }
        }
    }
}

} // namespace
} // namespace sundog
