// `sundog render --preview`: what arrives at the viewer, and that the render does not mind what becomes of it.
#include "cli/small_scene.h"
#include "cli/sundog_process.h"
#include "film/image_io.h"
#include "support/fake_tev.h"

namespace sundog::cli {
namespace {

using test::FakeTev;
using ::testing::HasSubstr;

class CliPreview : public InFolder {
protected:
    CliPreview() { write("scene.xml", SmallScene{}.xml()); }

    Outcome render(const std::string& address, const std::string& seconds) const
    {
        return run({"render", "scene.xml", "-t", seconds, "-o", "a.pfm", "--preview", address, "-q"});
    }
};

TEST_F(CliPreview, shows_the_image_about_once_a_second_and_at_the_end)
{
    FakeTev tev(FakeTev::Manners::reads);
    const Outcome outcome = render(tev.address(), "2.5");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    tev.stop();
    EXPECT_EQ(tev.error, "");
    EXPECT_EQ(tev.name, "a.pfm");
    EXPECT_EQ(tev.creations, 1);
    EXPECT_GE(tev.whole_images, 2); // the first and the last
    EXPECT_LE(tev.whole_images, 4); // after 0, 1 and 2 s, and the last
    const Image written = read_image(folder / "a.pfm");
    EXPECT_EQ(tev.image.width, written.width);
    EXPECT_EQ(tev.image.height, written.height);
    EXPECT_EQ(tev.image.channels, written.channels);
    EXPECT_TRUE(tev.image.pixels == written.pixels);
}

void expect_one_warning(const Outcome& outcome, const std::string& address)
{
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, ::testing::StartsWith("sundog: warning: no preview at " + address + ": "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(CliPreview, nobody_there_is_a_warning)
{
    std::string address;
    {
        FakeTev gone(FakeTev::Manners::hangs_up);
        address = gone.address();
    }
    const Outcome outcome = render(address, "0.2");
    expect_one_warning(outcome, address);
    EXPECT_THAT(outcome.err, HasSubstr("cannot connect: Connection refused; the render goes on without it"));
    EXPECT_EQ(read_image(folder / "a.pfm").width, 16);
}

TEST_F(CliPreview, a_lost_viewer_is_one_warning)
{
    FakeTev tev(FakeTev::Manners::hangs_up);
    expect_one_warning(render(tev.address(), "2.5"), tev.address());
    EXPECT_EQ(read_image(folder / "a.pfm").width, 16);
}

} // namespace
} // namespace sundog::cli
