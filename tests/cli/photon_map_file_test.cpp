// `-p save_map=FILE` and `-p load_map=FILE`: photon maps in a file, and what is refused.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"

namespace sundog::cli
{
namespace
{

class CliPhotonMapFile : public InFolder
{
protected:
    CliPhotonMapFile() { write("scene.xml", scene().xml()); }

    static SmallScene scene()
    {
        SmallScene scene;
        scene.extra =
            R"(<shape type="sphere"><point name="center" x="0.3" y="0" z="1"/><float name="radius" value="0.4"/><bsdf type="dielectric"/></shape>)";
        return scene;
    }

    Outcome render(const std::string& scene_file, const std::vector<std::string>& parameters) const
    {
        std::vector<std::string> arguments{"render", scene_file, "-m", "photonmapper", "-n", "2", "-o", "a.pfm", "-q"};
        for (const auto& parameter : parameters) arguments.insert(arguments.end(), {"-p", parameter});
        return run(arguments);
    }
    // The image, of a render that must succeed.
    std::string image(const std::vector<std::string>& parameters) const
    {
        const Outcome outcome = render("scene.xml", parameters);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return read("a.pfm");
    }
};

TEST_F(CliPhotonMapFile, LoadedMapsGiveTheSameImage)
{
    const std::string traced = image({"save_map=m", "photons=1500"});
    EXPECT_TRUE(image({"load_map=m"}) == traced);
    EXPECT_TRUE(image({"load_map=m", "photons=1500"}) == traced);
    EXPECT_FALSE(image({"photons=1501"}) == traced);
    // Other lookups of the same photons; another camera.
    EXPECT_FALSE(image({"load_map=m", "lookup=nearest", "nearest=5"}) == traced);
    SmallScene other = scene();
    other.sensor_start.replace(other.sensor_start.find("45"), 2, "40");
    write("scene.xml", other.xml());
    EXPECT_FALSE(image({"load_map=m"}) == traced);
}

TEST_F(CliPhotonMapFile, WhatTheMapsAreNotOfIsRefused)
{
    image({"save_map=m", "photons=1500"});
    const auto expect_refused = [&](const std::vector<std::string>& parameters, const std::string& why) {
        expect_failure(render("scene.xml", parameters), 5, {"m: cannot load photon maps, the file " + why, "trace them again"});
    };
    expect_refused({"load_map=m", "photons=1600"}, "was made with photons=1500, not photons=1600: use -p photons=1500");
    expect_refused({"load_map=m", "final_gather=false"}, "was made with final_gather=true, not final_gather=false");
    expect_refused({"load_map=m", "direct=photons"}, "was made with direct=nee");
    expect_refused({"load_map=m", "max_depth=5"}, "was made with max_depth=4, not max_depth=5");
    SmallScene brighter = scene();
    brighter.emitter.replace(brighter.emitter.find("10, 10, 10"), 10, "10, 10, 11");
    write("scene.xml", brighter.xml());
    expect_refused({"load_map=m"}, "is of another scene");
}

TEST_F(CliPhotonMapFile, DamagedMissingAndUnwritableFiles)
{
    expect_failure(render("scene.xml", {"load_map=nowhere"}), 5, {"nowhere: cannot load photon maps, there is no such file"});
    expect_failure(render("scene.xml", {"save_map=no/where"}), 5, {"no/where: cannot write, there is no folder no"});
    EXPECT_EQ(files(), std::vector<std::string>{"scene.xml"}) << "found before rendering";
    image({"save_map=m", "photons=300"});
    const std::string whole = read("m");
    for (const std::size_t size : {std::size_t(0), std::size_t(11), std::size_t(200), whole.size() / 2, whole.size() - 1}) {
        write("m", whole.substr(0, size));
        expect_failure(render("scene.xml", {"load_map=m"}), 5, {"m: cannot load photon maps, the file is"});
    }
    std::string changed = whole;
    changed[whole.size() / 2] ^= 1;
    write("m", changed);
    expect_failure(render("scene.xml", {"load_map=m"}), 5, {"m: cannot load photon maps, the file is damaged: the checksum"});
    ASSERT_EQ(run({"render", "scene.xml", "-n", "1", "-o", "a.pfm", "-q", "--checkpoint", "c"}).status, 0);
    expect_failure(render("scene.xml", {"load_map=c"}), 5, {"c: cannot load photon maps"});
}

TEST_F(CliPhotonMapFile, OtherMapsAreRefusedOnResuming)
{
    image({"save_map=m", "photons=300"});
    const std::vector<std::string> resume{"render", "scene.xml", "-m",         "photonmapper", "-o", "a.pfm",
                                          "-q",     "-p",        "load_map=m", "--checkpoint", "c",  "--resume"};
    const auto upto = [&](const char* iterations) {
        auto arguments = resume;
        arguments.insert(arguments.end(), {"-n", iterations});
        return run(arguments);
    };
    ASSERT_EQ(upto("1").status, 0);
    ASSERT_EQ(upto("2").status, 0);
    image({"save_map=m", "photons=301"});
    expect_failure(upto("3"), 5, {"cannot resume, the photon maps are not those that the render began with"});
}

TEST_F(CliPhotonMapFile, MeaninglessPairsAreRefusedByName)
{
    expect_failure(render("scene.xml", {"load_map=m", "save_map=n"}), 2, {"cannot take both save_map and load_map"});
    expect_failure(render("scene.xml", {"spectral=true", "save_map=m"}), 2, {"cannot take both spectral=true and save_map"});
    expect_failure(render("scene.xml", {"spectral=true", "load_map=m"}), 2, {"cannot take both spectral=true and load_map"});
    expect_failure(render("scene.xml", {"maps=fresh", "save_map=m"}), 2, {"cannot take both maps=fresh and save_map", "use -p maps=one"});
    expect_failure(render("scene.xml", {"maps=fresh", "load_map=m"}), 2, {"cannot take both maps=fresh and load_map", "use -p maps=one"});
    expect_failure(render("scene.xml", {"maps=fresh", "relaxation_progressive=true", "max_depth=-1"}), 2,
                   {"relaxation_progressive=true and maps=fresh", "use -p maps=one"});
    expect_failure(render("scene.xml", {"relaxation_progressive=true", "max_depth=-1", "save_map=m"}), 2,
                   {"relaxation_progressive=true and save_map"});
    expect_failure(render("scene.xml", {"relaxation_progressive=true", "max_depth=-1", "spectral=true"}), 2,
                   {"relaxation_progressive=true and spectral"});
    expect_failure(render("scene.xml", {"relaxation_progressive=true"}), 2,
                   {"sums light of all depths", "max_depth=4; use -p max_depth=-1"});
    expect_failure(render("scene.xml", {"precompute=true"}), 2,
                   {"precompute=true sums light of all depths", "max_depth=4; use -p max_depth=-1"});
    expect_failure(render("scene.xml", {"precompute=true", "max_depth=-1", "final_gather=false"}), 2, {"precompute", "final_gather=false"});
}

} // namespace
} // namespace sundog::cli
