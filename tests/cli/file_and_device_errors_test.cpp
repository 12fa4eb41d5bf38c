// Exit status 4 (device) and 5 (files), and `sundog compare`.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"
#include "film/image_io.h"
#include "support/places.h"

#include <limits>

namespace sundog::cli {
namespace {

class CliFiles : public InFolder {
protected:
    CliFiles() { write("scene.xml", SmallScene{}.xml()); }

    void write_grey(const std::string& name, int width, float value) const
    {
        Image image(width, 2, {"R", "G", "B"});
        for (float& v : image.pixels) v = value;
        write_image(folder / name, image);
    }
};

using CliDevice = CliFiles;
using CliCompare = CliFiles;

TEST_F(CliFiles, unusable_outputs_are_found_before_anything_is_loaded)
{
    std::filesystem::create_directory(folder / "folder.pfm");
    write("scene.xml", "broken"); // would be status 3
    expect_failure(run({"render", "scene.xml", "-o", "missing/a.pfm"}), 5, {"missing/a.pfm: ", "there is no folder missing"});
    expect_failure(run({"render", "scene.xml", "-o", "a.xyz"}), 5, {"a.xyz: ", "unknown ending .xyz; use ", ".pfm"});
    expect_failure(run({"render", "scene.xml", "-o", "image"}), 5, {"image: ", "has no ending"});
    expect_failure(run({"render", "scene.xml", "-o", "folder.pfm"}), 5, {"folder.pfm: ", "it is a folder"});
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm", "-o", "a.bmpp"}), 5, {"a.bmpp"});
    expect_failure(run({"render", "scene.xml", "-o", "/proc/a.pfm"}), 5, {"/proc/a.pfm: cannot write"});
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm", "--stats", "missing/s.json"}), 5, {"missing/s.json"});
    EXPECT_THAT(files(), ::testing::ElementsAre("folder.pfm", "scene.xml"));
}

TEST_F(CliFiles, a_folder_without_permission)
{
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm"}), 5, {"a.pfm", "Permission denied"});
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

TEST_F(CliDevice, none)
{
    std::filesystem::create_directory(folder / "vendors");
    const std::map<std::string, std::string> no_drivers{{"OCL_ICD_VENDORS", (folder / "vendors").string() + "/"}, {"OPENCL_VENDOR_PATH", (folder / "vendors").string()}};
    expect_failure(run({"devices"}, no_drivers), 4, {"pocl-opencl-icd"});
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm"}, no_drivers), 4, {"pocl-opencl-icd"});
    expect_failure(run({"bench"}, no_drivers), 4, {"pocl-opencl-icd"});
    EXPECT_THAT(files(), ::testing::ElementsAre("scene.xml", "vendors"));
}

TEST_F(CliDevice, no_such_device)
{
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm", "-d", "no such device"}), 4, {"no such device"});
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm", "-d", "99"}), 4, {"99"});
}

TEST_F(CliDevice, a_billion_photons_do_not_fit)
{
    expect_failure(run({"render", "scene.xml", "-o", "a.pfm", "-n", "1", "-m", "pppm", "-p", "photons=1000000000"}), 4, {"memory"});
    EXPECT_THAT(files(), ::testing::ElementsAre("scene.xml"));
}

TEST_F(CliCompare, metrics_are_printed_by_name)
{
    write_grey("a.pfm", 3, 3.0f);
    write_grey("b.pfm", 3, 2.0f);
    const Outcome outcome = run({"compare", "a.pfm", "b.pfm"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, "mse: 1\nrmse: 1\nrelmse: 0.249376559\nmae: 1\nmean_ratio: 1.5\n"); // 1 / 4.01
    EXPECT_EQ(outcome.err, "");
}

TEST_F(CliCompare, limits_set_the_status)
{
    write_grey("a.pfm", 3, 3.0f);
    write_grey("b.pfm", 3, 2.0f);
    EXPECT_EQ(run({"compare", "a.pfm", "b.pfm", "--max", "mse=1", "--max", "mean_ratio=1.5"}).status, 0);
    const Outcome outcome = run({"compare", "--max", "relmse=0.2", "a.pfm", "b.pfm", "--max", "mse=1"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "sundog: error: relmse is 0.249377, above the 0.2 that --max allows\n");
    EXPECT_THAT(outcome.out, ::testing::HasSubstr("mse: 1\n"));
}

TEST_F(CliCompare, unusable_images)
{
    write_grey("a.pfm", 3, 1.0f);
    write_grey("wide.pfm", 4, 1.0f);
    std::string nan = "PF\n3 2\n-1\n"; // as other programs write them
    for (int i = 0; i < 18; i++) nan.append("\0\0\xc0\x7f", 4);
    write("nan.pfm", nan);
    write("broken.pfm", "PF\n3 2\n-1.0\nxx");
    write("text.exr", "text");
    expect_failure(run({"compare", "a.pfm", "wide.pfm"}), 5, {"a.pfm is 3x2 but wide.pfm is 4x2"});
    expect_failure(run({"compare", "nan.pfm", "a.pfm"}), 5, {"nan.pfm: pixel (0, 0) is nan"});
    expect_failure(run({"compare", "a.pfm", "nan.pfm"}), 5, {"nan.pfm: pixel (0, 0) is nan"});
    expect_failure(run({"compare", "a.pfm", "none.pfm"}), 5, {"none.pfm: cannot read, there is no such file"});
    expect_failure(run({"compare", "broken.pfm", "a.pfm"}), 5, {"broken.pfm: ", "truncated"});
    expect_failure(run({"compare", "a.pfm", "text.exr"}), 5, {"text.exr: "});
    expect_failure(run({"compare", "a.pfm", "."}), 5, {"it is a folder"});
}

TEST_F(CliFiles, a_closed_standard_output_is_reported)
{
    std::ofstream full("/dev/full");
    if (!full) GTEST_SKIP() << "no /dev/full";
    write_grey("a.pfm", 3, 1.0f);
    const std::string command = std::string("cd '") + folder.string() + "' && '" + test::sundog_executable().string() + "' compare a.pfm a.pfm > /dev/full 2> error.txt";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 5);
    EXPECT_EQ(read("error.txt"), "sundog: error: cannot write to standard output\n");
}

} // namespace
} // namespace sundog::cli
