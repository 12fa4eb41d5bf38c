// A resumed render is the uninterrupted one, bit for bit: the image with all its channels, and the totals. Every
// registered method, since each says itself what it keeps.
#include "base/errors.h"
#include "shared/film.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <unistd.h>

using namespace sundog;
using namespace sundog::test;
using testing::HasSubstr;

namespace
{

constexpr std::uint64_t total_iterations = 5;

// A glass ball in a box, with a filter that reaches over the pixel; size is no multiple of a tile.
Scene glass_box(int size = 27)
{
    Scene scene = cornell_box(size);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    scene.shapes.push_back(make_sphere({.4f, -.6f, .3f}, .4f, glass));
    scene.film.filter = {FilterKind::gaussian, 2.0f, 0.5f, 0, 0};
    return scene;
}

RenderSettings settings_for(const std::string& method, const std::map<std::string, std::string>& parameters = {}, std::uint64_t seed = 7)
{
    RenderSettings settings;
    settings.method = method;
    settings.parameters = parameters;
    settings.seed = seed;
    return settings;
}

// Settings that ask for errors as well.
RenderSettings with_errors(RenderSettings settings)
{
    settings.errors = ErrorSettings{};
    return settings;
}

struct Result {
    std::vector<float> pixels;
    RenderStatistics statistics;
};

class Resume : public testing::Test
{
protected:
    Resume()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "sundog-resume-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
        checkpoint_ = folder_ / "render.checkpoint";
    }
    ~Resume() override { std::filesystem::remove_all(folder_); }

    // Renders to each count of iterations in turn, every time in a new session on a new device.
    Result render_in_parts(const RenderSettings& settings, const std::vector<std::uint64_t>& ends) const
    {
        Result result;
        bool resumed = false;
        for (std::uint64_t end : ends) {
            Device device(select_device(""));
            RenderSession session(glass_box(), device, settings);
            if (resumed) session.resume(checkpoint_);
            while (session.iterations_done() < end) session.iterate();
            session.save_checkpoint(checkpoint_);
            result = {session.image().pixels, session.statistics()};
            resumed = true;
        }
        return result;
    }

    // A checkpoint of `settings` after one iteration.
    void save_one(const RenderSettings& settings) const { render_in_parts(settings, {1}); }

    std::string refusal(const Scene& scene, const RenderSettings& settings) const
    {
        RenderSession session(scene, shared_device(), settings);
        try {
            session.resume(checkpoint_);
        } catch (const FileError& error) {
            return error.what();
        }
        ADD_FAILURE() << "resumed";
        return {};
    }

    std::filesystem::path folder_, checkpoint_;
};

class ResumeMethods : public Resume, public testing::WithParamInterface<std::string>
{
};

class ResumePhotonMaps : public ResumeMethods
{
};

class ResumeErrors : public ResumeMethods
{
};

std::vector<std::string> method_names()
{
    std::vector<std::string> names;
    for (const MethodInfo* method : all_methods()) names.push_back(method->name);
    return names;
}

bool has_parameter(const std::string& method, const std::string& name)
{
    const auto& specs = find_method(method)->parameters;
    return std::any_of(specs.begin(), specs.end(), [&](const ParameterSpec& spec) { return spec.name == name; });
}

// Those with a radius.
std::vector<std::string> photon_map_names()
{
    std::vector<std::string> names = method_names();
    std::erase_if(names, [](const std::string& name) { return !has_parameter(name, "radius"); });
    return names;
}

// Those that can tell their error.
std::vector<std::string> error_names()
{
    std::vector<std::string> names = method_names();
    std::erase_if(names, [](const std::string& name) { return find_method(name)->error_model == ErrorModel::none; });
    return names;
}

void expect_same(const Result& split, const Result& whole)
{
    EXPECT_TRUE(split.pixels == whole.pixels);
    const MethodCounters &a = split.statistics.counters, &b = whole.statistics.counters;
    EXPECT_EQ(split.statistics.iterations, whole.statistics.iterations);
    EXPECT_EQ(a.light_subpaths, b.light_subpaths);
    EXPECT_EQ(a.camera_subpaths, b.camera_subpaths);
    EXPECT_EQ(a.photons_stored, b.photons_stored);
    // Also tells whether lists had room at once, as they have in the uninterrupted render.
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(split.statistics.invalid_samples, whole.statistics.invalid_samples);
}

TEST_P(ResumeMethods, ResumedIsUninterrupted)
{
    const RenderSettings settings = settings_for(GetParam());
    const Result whole = render_in_parts(settings, {total_iterations});
    const std::vector<std::vector<std::uint64_t>> splits{{2, total_iterations}, {1, 2, 3, 4, total_iterations}};
    for (const auto& split : splits) {
        SCOPED_TRACE(testing::PrintToString(split));
        const Result parts = render_in_parts(settings, split);
        expect_same(parts, whole);
        EXPECT_EQ(parts.statistics.resumed_iterations, split[split.size() - 2]);
        EXPECT_GT(parts.statistics.render_seconds, 0.0);
    }
}

// Fine cells: the photon map hashes them, and lays photons out by the size of its table. There are more photons than
// paths, so that the list has to grow, which an uninterrupted render does but once.
TEST_P(ResumePhotonMaps, ResumedIsUninterruptedInAHashedGrid)
{
    std::map<std::string, std::string> parameters{{"radius", "0.02"}, {"photons", "3000"}};
    if (has_parameter(GetParam(), "direct")) parameters["direct"] = "photons";
    const RenderSettings settings = settings_for(GetParam(), parameters);
    const Result whole = render_in_parts(settings, {total_iterations});
    const std::uint64_t maps = GetParam() == "photonmapper" ? 1 : total_iterations; // one for all iterations, or one in each
    EXPECT_GT(whole.statistics.counters.photons_stored, maps * 3000);
    expect_same(render_in_parts(settings, {2, total_iterations}), whole);
}

// The channels of errors are part of the image.
TEST_P(ResumeErrors, ResumedIsUninterruptedWithErrors)
{
    const RenderSettings settings = with_errors(settings_for(GetParam(), find_method(GetParam())->errors_need));
    const Result whole = render_in_parts(settings, {total_iterations});
    EXPECT_GT(whole.pixels.size(), render_in_parts(settings_for(GetParam(), find_method(GetParam())->errors_need), {1}).pixels.size());
    const Result parts = render_in_parts(settings, {1, 3, total_iterations});
    expect_same(parts, whole);
    EXPECT_EQ(parts.statistics.error->bound, whole.statistics.error->bound);
}

// Asking for errors is no other render.
TEST_P(ResumeErrors, ErrorsLeaveTheImageAlone)
{
    const RenderSettings settings = settings_for(GetParam(), find_method(GetParam())->errors_need);
    const Result plain = render_in_parts(settings, {3}), asked = render_in_parts(with_errors(settings), {3});
    const std::size_t pixels = 27 * 27, channels = plain.pixels.size() / pixels, more = asked.pixels.size() / pixels;
    for (std::size_t i = 0; i < pixels; i++)
        for (std::size_t c = 0; c < channels; c++) ASSERT_EQ(asked.pixels[i * more + c], plain.pixels[i * channels + c]) << i << " " << c;
    EXPECT_EQ(asked.statistics.counters.photons_stored, plain.statistics.counters.photons_stored);
}

TEST_P(ResumeMethods, AnotherPartIsAnotherImage)
{
    const RenderSettings settings = settings_for(GetParam());
    EXPECT_FALSE(render_in_parts(settings, {4}).pixels == render_in_parts(settings, {total_iterations}).pixels);
}

INSTANTIATE_TEST_SUITE_P(Methods, ResumeMethods, testing::ValuesIn(method_names()), [](const auto& method) { return method.param; });
INSTANTIATE_TEST_SUITE_P(Methods, ResumePhotonMaps, testing::ValuesIn(photon_map_names()), [](const auto& method) { return method.param; });
INSTANTIATE_TEST_SUITE_P(Methods, ResumeErrors, testing::ValuesIn(error_names()), [](const auto& method) { return method.param; });

TEST_F(Resume, SecondsAddUp)
{
    const RenderSettings settings = settings_for("path");
    save_one(settings);
    RenderSession session(glass_box(), shared_device(), settings);
    session.resume(checkpoint_);
    const RenderStatistics before = session.statistics();
    EXPECT_GT(before.render_seconds, 0.0);
    session.iterate();
    EXPECT_GT(session.statistics().render_seconds, before.render_seconds);
}

TEST_F(Resume, AnotherRenderIsRefusedByName)
{
    save_one(settings_for("pppm"));
    EXPECT_THAT(refusal(glass_box(), settings_for("sppm")),
                HasSubstr("render.checkpoint: cannot resume, the checkpoint is of method pppm, not sppm; use -m pppm"));
    EXPECT_THAT(refusal(glass_box(), settings_for("pppm", {{"alpha", "0.5"}})), HasSubstr("not alpha=0.5; use -p alpha="));
    EXPECT_THAT(refusal(glass_box(), settings_for("pppm", {}, 8)), HasSubstr("is of seed 7, not 8; use -s 7"));
    EXPECT_THAT(
        refusal(glass_box(), with_errors(settings_for("pppm"))),
        HasSubstr("is of a render that does not estimate its error; leave out --errors, --error-image and --target-error, or choose"));
    EXPECT_THAT(refusal(glass_box(28), settings_for("pppm")), HasSubstr("is of 27x27 pixels, not 28x28"));
}

TEST_F(Resume, ARenderWithErrorsIsAnotherThanOneWithout)
{
    save_one(with_errors(settings_for("path")));
    EXPECT_THAT(refusal(glass_box(), settings_for("path")), HasSubstr("is of a render that estimates its error; use --errors, or choose"));
}

// Whatever changes a pixel is another scene; a moved file, and another goal, are not.
TEST_F(Resume, AnotherSceneIsRefused)
{
    save_one(settings_for("path"));
    const auto expect_refused = [&](const char* what, auto change) {
        Scene scene = glass_box();
        change(scene);
        EXPECT_THAT(refusal(scene, settings_for("path")), HasSubstr("is of another scene (cornell box, not ")) << what;
    };
    expect_refused("geometry", [](Scene& s) { std::get<TriangleMesh>(s.shapes[0].geometry).positions[0].x = -1.001f; });
    expect_refused("analytic shape", [](Scene& s) { std::get<Sphere>(s.shapes.back().geometry).radius = 0.41f; });
    expect_refused("material", [](Scene& s) { s.bsdfs[0].model = DiffuseBsdf{{0.75f, 0.75f, 0.76f}}; });
    expect_refused("light", [](Scene& s) { s.shapes[5].emitter->radiance.x = 16; });
    expect_refused("camera", [](Scene& s) { s.sensor.fov_x = 0.69f; });
    expect_refused("filter", [](Scene& s) { s.film.filter.radius = 1.5f; });

    Scene moved = glass_box();
    moved.file = "elsewhere/cornell box";
    RenderSession session(moved, shared_device(), settings_for("path", {{"iterations", "9"}}));
    session.resume(checkpoint_);
    EXPECT_EQ(session.iterations_done(), 1u);
}

TEST_F(Resume, DamageAnywhereIsFound)
{
    save_one(settings_for("sppm"));
    std::string whole;
    {
        std::ifstream file(checkpoint_, std::ios::binary);
        whole.assign(std::istreambuf_iterator<char>(file), {});
    }
    ASSERT_GT(whole.size(), 27u * 27u * (sizeof(FilmPixel) + sizeof(FirstHitPixel) + sizeof(ProgressivePixel) + sizeof(DirectSum)));
    RenderSession session(glass_box(), shared_device(), settings_for("sppm"));
    const auto refused = [&](const std::string& bytes) {
        std::ofstream(checkpoint_, std::ios::binary) << bytes;
        try {
            session.resume(checkpoint_);
        } catch (const FileError& error) {
            EXPECT_THAT(error.what(), HasSubstr("render.checkpoint: cannot resume"));
            return true;
        }
        return false;
    };
    // Ends in every part of the file: an odd stride visits headers, names, data and checksums.
    for (std::size_t size = 0; size < whole.size(); size += 997) EXPECT_TRUE(refused(whole.substr(0, size))) << size;
    EXPECT_TRUE(refused(whole.substr(0, whole.size() - 1)));
    EXPECT_TRUE(refused(whole + "x"));
    for (std::size_t at = 0; at < whole.size(); at += at < 1200 ? 7 : 1499) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x10);
        EXPECT_TRUE(refused(changed)) << at;
    }
    EXPECT_FALSE(refused(whole));
}

} // namespace
