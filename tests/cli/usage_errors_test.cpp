// Exit status 2: a wrong command, option, method, parameter or value.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"

namespace sundog::cli {
namespace {

struct UsageCase {
    const char* name;
    std::vector<std::string> arguments;
    std::vector<std::string> message;
};

void PrintTo(const UsageCase& test, std::ostream* out) { *out << test.name; }

class UsageErrors : public InFolder, public ::testing::WithParamInterface<UsageCase> {};

TEST_P(UsageErrors, status_2_and_one_line)
{
    write("scene.xml", SmallScene{}.xml());
    expect_failure(run(GetParam().arguments), 2, GetParam().message);
    EXPECT_THAT(files(), ::testing::ElementsAre("scene.xml"));
}

const UsageCase cases[] = {
    {"no_command", {}, {"no command given", "render, devices"}},
    {"unknown_command", {"rendr"}, {"unknown command \"rendr\"", "render"}},
    {"unknown_option", {"render", "scene.xml", "--fast"}, {"--fast", "see sundog render --help"}},
    {"unknown_global_option", {"--fast"}, {"see sundog --help"}},
    {"resume_from_nothing", {"render", "scene.xml", "--resume"}, {"--resume needs --checkpoint FILE"}},
    {"checkpoint_nowhere", {"render", "scene.xml", "--checkpoint-every", "10"}, {"--checkpoint-every needs --checkpoint FILE"}},
    {"checkpoint_all_the_time",
     {"render", "scene.xml", "--checkpoint", "c", "--checkpoint-every", "0"},
     {"--checkpoint-every must be more than 0 seconds"}},
    {"checkpoint_often",
     {"render", "scene.xml", "--checkpoint", "c", "--checkpoint-every", "often"},
     {"--checkpoint-every needs a number, got \"often\""}},
    {"target_error_zero",
     {"render", "scene.xml", "--target-error", "0"},
     {"--target-error must be more than 0, such as 0.05 for 5 percent, got \"0\""}},
    {"target_error_negative", {"render", "scene.xml", "--target-error=-0.1"}, {"--target-error must be more than 0"}},
    {"target_error_infinite", {"render", "scene.xml", "--target-error", "inf"}, {"--target-error needs a number, got \"inf\""}},
    {"target_error_percent", {"render", "scene.xml", "--target-error", "5%"}, {"--target-error needs a number, got \"5%\""}},
    {"error_confidence_one",
     {"render", "scene.xml", "--errors", "--error-confidence", "1"},
     {"--error-confidence must lie between 0 and 1, such as 0.9"}},
    {"error_confidence_percent",
     {"render", "scene.xml", "--errors", "--error-confidence", "90"},
     {"--error-confidence must lie between 0 and 1"}},
    {"error_confidence_of_nothing",
     {"render", "scene.xml", "--error-confidence", "0.9"},
     {"--error-confidence needs --errors, --error-image FILE or --target-error E"}},
    {"preview_without_port", {"render", "scene.xml", "--preview", "localhost"}, {"--preview needs HOST:PORT", "got \"localhost\""}},
    {"preview_without_host", {"render", "scene.xml", "--preview", ":14158"}, {"--preview needs HOST:PORT"}},
    {"preview_port_range", {"render", "scene.xml", "--preview", "localhost:65536"}, {"--preview needs HOST:PORT"}},
    {"preview_port_zero", {"render", "scene.xml", "--preview", "localhost:0"}, {"--preview needs HOST:PORT"}},
    {"preview_bare_ipv6", {"render", "scene.xml", "--preview", "::1:14158"}, {"--preview needs HOST:PORT"}},
    {"merge_nothing", {"merge", "out.exr"}, {"PART"}},
    {"merge_exposure", {"merge", "out.exr", "a.exr", "--exposure", "bright"}, {"--exposure needs a number"}},
    {"no_scene", {"render"}, {"SCENE is required"}},
    {"two_scenes", {"render", "scene.xml", "other.xml"}, {"other.xml"}},
    {"option_without_value", {"render", "scene.xml", "-o"}, {"--output"}},
    {"iterations_zero", {"render", "scene.xml", "-n", "0"}, {"--iterations must be at least 1"}},
    {"iterations_negative", {"render", "scene.xml", "--iterations=-5"}, {"--iterations needs a non-negative integer, got \"-5\""}},
    {"iterations_no_number", {"render", "scene.xml", "-n", "many"}, {"--iterations", "many"}},
    {"iterations_fraction", {"render", "scene.xml", "-n", "1.5"}, {"--iterations", "1.5"}},
    {"time_zero", {"render", "scene.xml", "-t", "0"}, {"--time must be more than 0"}},
    {"time_nan", {"render", "scene.xml", "-t", "nan"}, {"--time needs a number, got \"nan\""}},
    {"seed_negative", {"render", "scene.xml", "--seed=-1"}, {"--seed", "-1"}},
    {"seed_no_number", {"render", "scene.xml", "-s", "x"}, {"--seed", "x"}},
    {"size_zero", {"render", "scene.xml", "--size", "0x10"}, {"--size needs WIDTHxHEIGHT", "0x10"}},
    {"size_one_number", {"render", "scene.xml", "--size", "512"}, {"--size needs WIDTHxHEIGHT", "512"}},
    {"size_letters", {"render", "scene.xml", "--size", "axb"}, {"axb"}},
    {"size_negative", {"render", "scene.xml", "--size", "10x-5"}, {"10x-5"}},
    {"size_huge", {"render", "scene.xml", "--size", "99999999999x1"}, {"99999999999x1"}},
    {"exposure", {"render", "scene.xml", "--exposure", "bright"}, {"--exposure needs a number, got \"bright\""}},
    {"progress", {"render", "scene.xml", "--progress", "loud"}, {"--progress must be auto, bar, plain, json or off, got \"loud\""}},
    {"define", {"render", "scene.xml", "-D", "height"}, {"-D needs NAME=VALUE, got \"height\""}},
    {"define_without_name", {"render", "scene.xml", "-D", "=3"}, {"-D needs NAME=VALUE"}},
    {"parameter_form", {"render", "scene.xml", "-p", "max_depth"}, {"--param needs NAME=VALUE, got \"max_depth\""}},
    {"method", {"render", "scene.xml", "-m", "magic"}, {"unknown method \"magic\"", "sundog methods"}},
    {"parameter_of_another_policy",
     {"render", "scene.xml", "-m", "pppm", "-p", "significance=0.1"},
     {"significance means nothing with radius_policy=schedule; it belongs to radius_policy=chi_squared"}},
    {"kernel_of_sppm",
     {"render", "scene.xml", "-m", "sppm", "-p", "kernel=biweight"},
     {"sppm rescales the flux", "kernel=uniform", "-m pppm"}},
    {"kernel_of_ppm",
     {"render", "scene.xml", "-m", "ppm", "-p", "kernel=biweight"},
     {"ppm rescales the flux", "kernel=uniform", "-m pppm"}},
    {"picks_of_own_connections", {"render", "scene.xml", "-m", "bdpt", "-p", "picks=2"}, {"use -p connections=resampled"}},
    {"picks_without_connections",
     {"render", "scene.xml", "-m", "vcm", "-p", "connections=none", "-p", "picks=2"},
     {"use -p connections=resampled"}},
    {"nothing_joins_subpaths",
     {"render", "scene.xml", "-m", "vcm", "-p", "connections=none", "-p", "merging=false"},
     {"vcm cannot do without both connections and merging"}},
    {"light_subpaths_of_paths", {"render", "scene.xml", "-m", "psr", "-p", "photons=100"}, {"photons is for light subpaths", "use -p paths=bdpt"}},
    {"chains_of_paths", {"render", "scene.xml", "-m", "psr", "-p", "chains=100"}, {"chains is for Markov chains", "use -p paths=pssmlt"}},
    {"sampler_of_chains", {"render", "scene.xml", "-m", "psr", "-p", "paths=pssmlt", "-p", "sampler=sobol"}, {"Markov chains have no sampler"}},
    {"angle_of_nothing", {"render", "scene.xml", "-m", "psr", "-p", "angle=0"}, {"angle"}},
    {"policy_of_ppm", {"render", "scene.xml", "-m", "ppm", "-p", "radius_policy=fixed"}, {"radius_policy=local", "-m pppm"}},
    {"light_choice_of_photons",
     {"render", "scene.xml", "-m", "sppm", "-p", "direct=photons", "-p", "light_choice=tree"},
     {"light_choice=tree is for next-event estimation", "direct=photons"}},
    {"light_choice_without_connections",
     {"render", "scene.xml", "-m", "vcm", "-p", "connections=none", "-p", "light_choice=tree"},
     {"light_choice=tree is for next-event estimation", "connections=none"}},
    {"light_choice_of_bpm", {"render", "scene.xml", "-m", "bpm", "-p", "light_choice=power"}, {"bpm has no parameter \"light_choice\""}},
    {"parameter_name", {"render", "scene.xml", "-p", "magic=1"}, {"path has no parameter \"magic\"", "max_depth"}},
    {"parameter_type", {"render", "scene.xml", "-p", "max_depth=deep"}, {"parameter max_depth of path must be an integer", "got \"deep\""}},
    {"parameter_range", {"render", "scene.xml", "-p", "max_depth=-7"}, {"parameter max_depth of path must be", "got \"-7\""}},
    {"parameter_choice",
     {"render", "scene.xml", "-m", "pppm", "-p", "kernel=round"},
     {"parameter kernel of pppm must be one of", "got \"round\""}},
    {"alpha_range", {"render", "scene.xml", "-m", "sppm", "-p", "alpha=2"}, {"parameter alpha of sppm must be a number from", "got \"2\""}},
    {"methods_name", {"methods", "magic"}, {"unknown method \"magic\""}},
    {"info_no_scene", {"info"}, {"SCENE is required"}},
    {"compare_one_image", {"compare", "a.exr"}, {"REFERENCE is required"}},
    {"compare_metric", {"compare", "a.exr", "b.exr", "--max", "psnr=3"}, {"--max knows no metric \"psnr\""}},
    {"compare_limit", {"compare", "a.exr", "b.exr", "--max", "mse=low"}, {"--max mse needs a number, got \"low\""}},
    {"compare_limit_form", {"compare", "a.exr", "b.exr", "--max", "mse"}, {"--max needs NAME=VALUE"}},
    {"bench_section", {"bench", "--section", "speed"}, {"unknown bench section \"speed\"", "traversal"}},
};

INSTANTIATE_TEST_SUITE_P(Cli, UsageErrors, ::testing::ValuesIn(cases), [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace sundog::cli
