// Programs for any scene (SUNDOG_GENERAL_PROGRAMS), which most tests use, and those for the scene's own materials and lights,
// which renders use, make the same image.
#include "base/errors.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace sundog;
using namespace sundog::test;

namespace {

// Sets the variable (empty: as if it were not there) until the end of its scope.
class ProgramChoice {
public:
    explicit ProgramChoice(const char* value)
    {
        if (const char* before = std::getenv(name)) before_ = before;
        ::setenv(name, value, 1);
    }
    ~ProgramChoice() { ::setenv(name, before_.c_str(), 1); }
    ProgramChoice(const ProgramChoice&) = delete;
    ProgramChoice& operator=(const ProgramChoice&) = delete;

private:
    static constexpr const char* name = "SUNDOG_GENERAL_PROGRAMS";
    std::string before_;
};

std::vector<float> pixels_with(const char* choice, const Scene& scene, const std::string& method)
{
    const ProgramChoice general(choice);
    return render(scene, {method, 2, {}}, 7).pixels;
}

Scene rough_box()
{
    Scene scene = glass_box(24);
    const uint metal = add_bsdf(scene, ConductorBsdf{{0.2f, 0.9f, 1.1f}, {3.9f, 2.5f, 2.1f}, {}, Roughness{false, 0.3f, 0.3f}});
    const uint plastic = add_bsdf(scene, PlasticBsdf{1.5f, 1.0f, {.2f, .3f, .7f}, {1, 1, 1}, false, Roughness{false, 0.3f, 0.3f}});
    scene.shapes.push_back(make_sphere({-.5f, -.6f, .3f}, .3f, metal));
    scene.shapes.push_back(make_sphere({-.3f, .3f, -.3f}, .3f, plastic));
    scene.emitters.push_back({{}, PointEmitter{{0, 0, .5f}, {.5f, .5f, .5f}}});
    return scene;
}

// Share of values that differ by more than rounding. That is 1e-5 at rough lobes, whose sums the compiler orders by the code that
// it sees beside them; rarely it turns a path elsewhere.
double share_that_differs(const std::vector<float>& a, const std::vector<float>& b)
{
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); i++) different += !(std::abs(a[i] - b[i]) <= 1e-4f * (1e-3f + std::abs(a[i])));
    return static_cast<double>(different) / static_cast<double>(a.size());
}

TEST(GeneralPrograms, MakeTheImageOfTheScenesOwn)
{
    for (const char* method : {"path", "vcm"}) {
        const std::vector<float> general = pixels_with("1", rough_box(), method), own = pixels_with("", rough_box(), method);
        ASSERT_EQ(general.size(), own.size());
        EXPECT_LT(share_that_differs(general, own), 0.01) << method;
    }
}

TEST(GeneralPrograms, SwitchIsANumber)
{
    EXPECT_THROW(pixels_with("yes", cornell_box(4), "path"), DeviceError);
}

} // namespace
