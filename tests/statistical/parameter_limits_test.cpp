// Extreme values of every parameter of every method, on a small film: each is refused by name, or the image is finite.
#include "base/errors.h"
#include "methods/method.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace sundog;
using namespace sundog::test;
using testing::HasSubstr;

namespace
{

std::vector<std::string> extreme_values(const ParameterSpec& spec)
{
    if (spec.type == ParameterType::real) return {"0", "1e-30", "1e-9", fmt::format("{}", spec.minimum), fmt::format("{}", spec.maximum), "1e30", "-1e30"};
    if (spec.type != ParameterType::integer) return {};
    const auto whole = [](double value) { return std::to_string(static_cast<long long>(value)); };
    return {"0", "1", whole(spec.minimum), whole(spec.maximum), "9000000000000000000"};
}

// What takes long because it is asked for: nothing is wrong with it.
bool is_only_slow(const std::string& name, const std::string& value)
{
    return (name == "seeds" || name == "relaxation" || name == "first_test" || name == "caustic_photons") && value != "0" && value != "1";
}

// Which value of another parameter gives this one a meaning.
std::map<std::string, std::string> needed_for(const MethodInfo& info, const std::string& name)
{
    const auto has = [&](const char* other) { return std::any_of(info.parameters.begin(), info.parameters.end(), [&](const auto& spec) { return spec.name == other; }); };
    if (name == "nearest") return {{"lookup", "nearest"}};
    if (name == "picks") return has("paths") ? std::map<std::string, std::string>{{"paths", "bdpt"}, {"connections", "resampled"}}
                                             : std::map<std::string, std::string>{{"connections", "resampled"}};
    if (info.name == "psr" && name == "photons") return {{"paths", "bdpt"}};
    if (info.name == "psr" && (name == "chains" || name == "large_step" || name == "seeds")) return {{"paths", "pssmlt"}};
    if (has("radius_policy") && info.name != "ppm") {
        if (name == "alpha") return {{"radius_policy", "schedule"}};
        if (name == "significance" || name == "shrink" || name == "first_test") return {{"radius_policy", "chi_squared"}};
    }
    return {};
}

// "" where the image is finite; the message where the value is refused; throws what nobody foresaw.
std::string outcome(const std::string& method, const std::map<std::string, std::string>& parameters, bool with_errors)
{
    RenderSettings settings;
    settings.method = method;
    settings.parameters = parameters;
    if (with_errors) settings.errors = ErrorSettings{};
    try {
        RenderSession session(glass_box(4), shared_device(), settings);
        session.iterate();
        session.iterate();
        const Image image = session.image();
        for (float value : image.pixels)
            if (!std::isfinite(value)) return "not finite";
        return session.statistics().invalid_samples > 0 ? "invalid samples" : "";
    } catch (const UsageError& error) {
        return error.what();
    } catch (const DeviceError& error) { // more than its memory
        return error.what();
    }
}

class ParameterLimits : public testing::TestWithParam<std::string>
{
};

TEST_P(ParameterLimits, AreRefusedOrFinite)
{
    const MethodInfo& info = *find_method(GetParam());
    int finite = 0;
    for (const ParameterSpec& spec : info.parameters)
        for (const std::string& value : extreme_values(spec)) {
            if (is_only_slow(spec.name, value)) continue;
            SCOPED_TRACE(spec.name + "=" + value);
            auto parameters = needed_for(info, spec.name);
            parameters[spec.name] = value;
            const bool with_errors = spec.name.find("radius") != std::string::npos && info.error_model != ErrorModel::none && info.errors_need.empty();
            const std::string message = outcome(info.name, parameters, with_errors);
            if (message.empty()) finite++;
            else EXPECT_THAT(message, HasSubstr(spec.name)) << "not refused by name";
        }
    EXPECT_GE(finite, 5) << "hardly anything was rendered";
}

// Hundreds of millions of chains or seeds take minutes.
bool is_slow(const std::string& method)
{
    return method == "pssmlt" || method == "psr";
}

std::vector<std::string> names_of_methods(bool slow)
{
    std::vector<std::string> names;
    for (const MethodInfo* info : all_methods())
        if (is_slow(info->name) == slow) names.push_back(info->name);
    return names;
}

std::string name_of(const testing::TestParamInfo<std::string>& test)
{
    return test.param;
}

INSTANTIATE_TEST_SUITE_P(Methods, ParameterLimits, testing::ValuesIn(names_of_methods(false)), name_of);
INSTANTIATE_TEST_SUITE_P(LongMethods, ParameterLimits, testing::ValuesIn(names_of_methods(true)), name_of);

} // namespace
