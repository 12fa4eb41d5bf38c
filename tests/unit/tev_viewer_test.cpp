// The viewer's protocol, and viewers that do not keep to it.
#include "base/timer.h"
#include "film/tev_viewer.h"
#include "support/fake_tev.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sundog {
namespace {

using test::FakeTev;
using ::testing::HasSubstr;

// Channels in another order than they are sent, and one that is not sent; values tell where they belong.
Image numbered_image(int width, int height)
{
    Image image(width, height, {"depth.Z", "B", "G", "R"});
    for (std::size_t i = 0; i < image.pixels.size(); i++) image.pixels[i] = static_cast<float>(i);
    return image;
}

TEST(TevViewerProtocol, an_image_arrives_as_it_is)
{
    FakeTev tev(FakeTev::Manners::reads);
    TevViewer viewer("127.0.0.1", tev.port(), "a.exr");
    const Image image = numbered_image(700, 300); // 2.5 MB: more than one message
    viewer.show(image);
    viewer.finish(20.0);
    EXPECT_EQ(viewer.take_problem(), std::nullopt);
    tev.stop();
    EXPECT_EQ(tev.error, "");
    EXPECT_EQ(tev.name, "a.exr");
    ASSERT_EQ(tev.image.width, 700);
    ASSERT_EQ(tev.image.height, 300);
    EXPECT_THAT(tev.image.channels, ::testing::ElementsAre("R", "G", "B"));
    for (int y = 0; y < 300; y++)
        for (int x = 0; x < 700; x++)
            for (int c = 0; c < 3; c++) ASSERT_EQ(tev.image.at(x, y, c), image.at(x, y, 3 - c)) << x << ' ' << y << ' ' << c;
}

TEST(TevViewerProtocol, the_last_of_several_images_stays)
{
    FakeTev tev(FakeTev::Manners::reads);
    TevViewer viewer("127.0.0.1", tev.port(), "a.exr");
    Image image = numbered_image(5, 4);
    viewer.show(image);
    while (viewer.busy()) std::this_thread::yield();
    for (float& value : image.pixels) value += 1000.0f;
    viewer.show(image);
    viewer.finish(20.0);
    tev.stop();
    EXPECT_EQ(tev.error, "");
    EXPECT_EQ(tev.creations, 1);
    EXPECT_EQ(tev.whole_images, 2);
    EXPECT_EQ(tev.image.at(4, 3, 0), image.at(4, 3, 3));
}

TEST(TevViewerProtocol, nobody_there)
{
    std::string port;
    {
        FakeTev gone(FakeTev::Manners::hangs_up);
        port = gone.port();
    }
    TevViewer viewer("127.0.0.1", port, "a.exr");
    viewer.show(numbered_image(5, 4));
    viewer.finish(20.0);
    EXPECT_THAT(viewer.take_problem().value_or(""), HasSubstr("cannot connect: "));
    EXPECT_EQ(viewer.take_problem(), std::nullopt) << "told once";
    EXPECT_FALSE(viewer.busy());
}

TEST(TevViewerProtocol, no_such_host)
{
    TevViewer viewer("no-such-host.invalid", "14158", "a.exr");
    viewer.show(numbered_image(5, 4));
    viewer.finish(20.0);
    EXPECT_TRUE(viewer.take_problem()); // found missing, or looked up for too long
}

TEST(TevViewerProtocol, a_viewer_that_hangs_up)
{
    FakeTev tev(FakeTev::Manners::hangs_up);
    TevViewer viewer("127.0.0.1", tev.port(), "a.exr");
    tev.stop(); // accepted and closed, or refused
    viewer.show(numbered_image(700, 300));
    viewer.finish(20.0);
    EXPECT_TRUE(viewer.take_problem());
}

TEST(TevViewerProtocol, a_viewer_that_does_not_read_holds_up_nobody)
{
    FakeTev tev(FakeTev::Manners::reads_nothing);
    TevViewer viewer("127.0.0.1", tev.port(), "a.exr");
    const Timer timer;
    viewer.show(numbered_image(4000, 2000)); // 96 MB: beyond every socket's buffers
    const double shown = timer.seconds();
    viewer.finish(0.2);
    EXPECT_THAT(viewer.take_problem().value_or(""), HasSubstr("does not read"));
    EXPECT_LT(timer.seconds() - shown, 5.0); // the 0.2 s, and room for a loaded machine; its patience alone is 10 s
}

} // namespace
} // namespace sundog
