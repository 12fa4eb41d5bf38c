// Parameters of methods: parsed, checked, and refused with a message that helps.
#include "methods/method.h"
#include "methods/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace sundog {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;

const std::vector<ParameterSpec> specs = {
    {"photons", ParameterType::integer, "0", "", "", 0, 1e18, {}},
    {"radius", ParameterType::real, "0", "scene units", "", 0, 1e30, {}},
    {"alpha", ParameterType::real, "0.6666666666666666", "", "", 0, 1, {}},
    {"max_depth", ParameterType::integer, "-1", "", "", -1, 1000, {}},
    {"volumes", ParameterType::boolean, "true", "", "", 0, 0, {}},
    {"kernel", ParameterType::choice, "epanechnikov", "", "", 0, 0, {"uniform", "epanechnikov"}},
    {"offset", ParameterType::real, "-3.5", "", "", 0, 0, {}}, // no limits
};

Parameters command_line(const std::string& name, const std::string& text)
{
    return Parameters("sppm", specs, {{name, {text, {}}}});
}

TEST(MethodParameters, defaults_are_in_force_until_set)
{
    const Parameters p("sppm", specs, {});
    EXPECT_EQ(p.integer("photons"), 0);
    EXPECT_EQ(p.real("alpha"), 2.0 / 3.0);
    EXPECT_EQ(p.integer("max_depth"), -1);
    EXPECT_TRUE(p.boolean("volumes"));
    EXPECT_EQ(p.text("kernel"), "epanechnikov");
    EXPECT_EQ(p.real("offset"), -3.5);
    EXPECT_FALSE(p.is_set("alpha"));
    EXPECT_EQ(p.all().size(), specs.size());
    EXPECT_THAT(p.all().front(), Pair("photons", "0"));
    EXPECT_TRUE(command_line("alpha", "0.5").is_set("alpha"));
    EXPECT_FALSE(command_line("alpha", "0.5").is_set("radius"));
}

TEST(MethodParameters, values_are_parsed_whole)
{
    EXPECT_EQ(command_line("photons", "1000000000").integer("photons"), 1000000000);
    EXPECT_EQ(command_line("photons", "1e6").integer("photons"), 1000000);
    EXPECT_EQ(command_line("photons", " 7\n").integer("photons"), 7);
    EXPECT_EQ(command_line("radius", "1e-3").real("radius"), 1e-3);
    EXPECT_EQ(command_line("radius", "+.5").real("radius"), 0.5);
    EXPECT_FALSE(command_line("volumes", "false").boolean("volumes"));
    EXPECT_EQ(command_line("kernel", "uniform").text("kernel"), "uniform");
    EXPECT_EQ(command_line("offset", "-1e20").real("offset"), -1e20);
}

TEST(MethodParameters, one_value_has_one_spelling)
{
    EXPECT_EQ(command_line("radius", "0.50").text("radius"), command_line("radius", "5e-1").text("radius"));
    EXPECT_EQ(command_line("photons", "007").text("photons"), "7");
}

TEST(MethodParameters, wrong_values_on_the_command_line_are_usage_errors)
{
    const std::pair<const char*, const char*> wrong[] = {
        {"photons", "many"},   {"photons", ""},        {"photons", "1.5"},    {"photons", "-1"}, {"photons", "1e40"}, {"photons", "12abc"},
        {"photons", "0x10"},   {"photons", "1.5e0"},   {"photons", "+-3"},    {"radius", "-1"},  {"radius", "nan"},   {"radius", "inf"},
        {"radius", "1e999"},   {"radius", "one"},      {"radius", "1,5"},     {"alpha", "1.01"}, {"max_depth", "-2"}, {"max_depth", "1001"},
        {"volumes", "1"},      {"volumes", "True"},    {"kernel", "gauss"},   {"kernel", ""},    {"offset", "--3"},   {"photons", "99999999999999999999"},
    };
    for (const auto& [name, text] : wrong) {
        const auto use = [n = name, t = text] { command_line(n, t); };
        const std::string start = std::string("parameter ") + name + " of sppm must be ", end = "got \"" + std::string(text) + "\"";
        EXPECT_THAT(use, ThrowsMessage<UsageError>(AllOf(HasSubstr(start), HasSubstr(end)))) << name << "=" << text;
    }
}

TEST(MethodParameters, messages_say_what_is_allowed)
{
    EXPECT_THAT([] { command_line("alpha", "2"); }, ThrowsMessage<UsageError>(HasSubstr("must be a number from 0 to 1, got \"2\"")));
    EXPECT_THAT([] { command_line("photons", "-5"); }, ThrowsMessage<UsageError>(HasSubstr("an integer from 0 to 1e+18, got \"-5\"")));
    EXPECT_THAT([] { command_line("photons", "1e30"); }, ThrowsMessage<UsageError>(HasSubstr("an integer from 0 to 1e+18, got \"1e30\"")));
    EXPECT_THAT([] { command_line("kernel", "x"); }, ThrowsMessage<UsageError>(HasSubstr("one of uniform, epanechnikov")));
    EXPECT_THAT([] { command_line("volumes", "x"); }, ThrowsMessage<UsageError>(HasSubstr("true or false")));
    EXPECT_THAT([] { command_line("foo", "1"); },
                ThrowsMessage<UsageError>(HasSubstr("sppm has no parameter \"foo\"; it has photons, radius, alpha, max_depth, volumes, kernel, offset")));
}

TEST(MethodParameters, wrong_values_in_a_scene_point_at_their_line)
{
    const SourceLocation where{"room.xml", 12};
    EXPECT_THAT([&] { Parameters("sppm", specs, {{"alpha", {"x", where}}}); },
                ThrowsMessage<SceneError>(HasSubstr("room.xml:12: parameter alpha of sppm must be")));
    EXPECT_THAT([&] { Parameters("sppm", specs, {{"beta", {"1", where}}}); }, ThrowsMessage<SceneError>(HasSubstr("room.xml:12: sppm has no parameter")));
}

TEST(MethodParameters, file_names_are_taken_as_they_are)
{
    const std::vector<ParameterSpec> with_file = {{"map", ParameterType::file, "", "", "", 0, 0, {}}};
    EXPECT_EQ(Parameters("m", with_file, {}).text("map"), "");
    EXPECT_EQ(Parameters("m", with_file, {{"map", {"a folder/true 1.map", {}}}}).text("map"), "a folder/true 1.map");
}

TEST(MethodParameters, values_that_do_not_go_together_are_refused_where_they_were_set)
{
    EXPECT_THAT([] { command_line("alpha", "1").refuse("alpha", "not with this"); }, ThrowsMessage<UsageError>(HasSubstr("not with this")));
    EXPECT_THAT([] { Parameters("sppm", specs, {{"alpha", {"1", {"room.xml", 12}}}}).refuse("alpha", "not with this"); },
                ThrowsMessage<SceneError>(HasSubstr("room.xml:12: not with this")));
    EXPECT_THAT([] { command_line("alpha", "1").refuse("radius", "not with this"); }, ThrowsMessage<UsageError>(HasSubstr("not with this")));
}

TEST(MethodParameters, a_wrong_default_is_a_bug)
{
    EXPECT_THROW(Parameters("m", {{"n", ParameterType::integer, "x", "", "", 0, 10, {}}}, {}), std::logic_error);
    EXPECT_THROW(Parameters("m", {{"n", ParameterType::integer, "11", "", "", 0, 10, {}}}, {}), std::logic_error);
    EXPECT_THROW(Parameters("sppm", specs, {}).real("nothing"), std::logic_error);
}

// What every registered method promises its users.
TEST(MethodRegistry, methods_are_documented_and_their_defaults_hold)
{
    std::set<std::string> names;
    for (const MethodInfo* method : all_methods()) {
        EXPECT_TRUE(names.insert(method->name).second);
        EXPECT_EQ(find_method(method->name), method);
        EXPECT_FALSE(method->title.empty()) << method->name;
        EXPECT_FALSE(method->paper.empty()) << method->name;
        EXPECT_FALSE(method->description.empty()) << method->name;
        EXPECT_THAT(method->estimator_class, ::testing::AnyOf("unbiased", "consistent", "biased")) << method->name;
        EXPECT_NE(method->create, nullptr) << method->name;
        EXPECT_NO_THROW(Parameters(method->name, method->parameters, {})) << method->name;
        for (const ParameterSpec& spec : method->parameters) EXPECT_FALSE(spec.description.empty()) << method->name << " " << spec.name;
    }
    EXPECT_EQ(find_method("no such method"), nullptr);
}

} // namespace
} // namespace sundog
