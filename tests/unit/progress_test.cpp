// What a user sees while a render runs.
#include "base/log.h"
#include "base/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace sundog {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST(ProgressReport, durations_read_like_a_clock)
{
    EXPECT_EQ(format_duration(0), "0:00");
    EXPECT_EQ(format_duration(7.4), "0:07");
    EXPECT_EQ(format_duration(59.6), "1:00");
    EXPECT_EQ(format_duration(754), "12:34");
    EXPECT_EQ(format_duration(3 * 3600 + 25 * 60 + 1), "3:25:01");
    EXPECT_EQ(format_duration(-1), "0:00");
}

TEST(ProgressReport, modes_have_names)
{
    EXPECT_EQ(parse_progress_mode("json"), ProgressMode::json);
    EXPECT_EQ(parse_progress_mode("off"), ProgressMode::off);
    EXPECT_EQ(parse_progress_mode("loud"), std::nullopt);
    EXPECT_TRUE(parse_progress_mode("auto"));
}

TEST(ProgressReport, a_resumed_render_is_as_fast_as_its_own_iterations)
{
    std::ostringstream out;
    Progress progress(ProgressMode::json, {100, std::nullopt, 60}, out);
    progress.update(60, 0.0);
    progress.update(80, 10.0);
    const auto lines = lines_of(out.str());
    const auto first = nlohmann::json::parse(lines.front()), last = nlohmann::json::parse(lines.back());
    EXPECT_EQ(first["fraction"], 0.6);
    EXPECT_TRUE(first["iterations_per_second"].is_null());
    EXPECT_EQ(last["fraction"], 0.8);
    EXPECT_EQ(last["iterations_per_second"], 2.0);
    EXPECT_EQ(last["seconds_left"], 10.0);
}

TEST(ProgressReport, bar_redraws_one_line_within_the_terminal)
{
    std::ostringstream out;
    Progress progress(ProgressMode::bar, {200, std::nullopt}, out, 80);
    progress.update(0, 0.0);
    progress.update(50, 10.0);
    EXPECT_THAT(out.str(), HasSubstr(" 25%  50/200 iterations, 5.00/s, 0:10, 0:30 left"));
    EXPECT_THAT(out.str(), Not(HasSubstr("\n")));
    progress.finish(200, 40.0);
    EXPECT_THAT(out.str(), HasSubstr("100%"));
    EXPECT_EQ(out.str().back(), '\n');
    std::string row;
    for (char c : out.str()) {
        row = c == '\r' || c == '\n' ? std::string() : row + c;
        EXPECT_LT(row.size(), 80u + 4u); // the erase sequence is 4 characters
    }
}

TEST(ProgressReport, bar_is_drawn_at_most_ten_times_a_second)
{
    std::ostringstream out;
    Progress progress(ProgressMode::bar, {1000, std::nullopt}, out, 80);
    for (int i = 0; i < 1000; ++i) progress.update(static_cast<std::uint64_t>(i), i * 0.001);
    const std::string text = out.str();
    const auto draws = std::count(text.begin(), text.end(), '\r');
    EXPECT_LE(draws, 11);
    EXPECT_GE(draws, 9);
}

TEST(ProgressReport, narrow_terminals_get_a_cut_line)
{
    std::ostringstream out;
    Progress progress(ProgressMode::bar, {10, std::nullopt}, out, 12);
    progress.update(5, 1.0);
    EXPECT_LE(out.str().size(), 11u + 5u);
}

TEST(ProgressReport, plain_lines_come_seldom)
{
    std::ostringstream out;
    Progress progress(ProgressMode::plain, {100, std::nullopt}, out);
    for (int i = 0; i <= 100; ++i) progress.update(static_cast<std::uint64_t>(i), 0.31 * i);
    progress.finish(100, 31.0);
    const auto lines = lines_of(out.str());
    ASSERT_EQ(lines.size(), 5u); // at 2, 5, 15 and 25 s, and the end
    EXPECT_THAT(lines[0], ::testing::StartsWith("sundog: 7%, 7/100 iterations, 3.23/s, 0:02, 0:29 left"));
    EXPECT_THAT(lines[4], ::testing::StartsWith("sundog: 100%, 100/100 iterations"));
}

TEST(ProgressReport, short_renders_are_silent_in_plain_mode)
{
    std::ostringstream out;
    Progress progress(ProgressMode::plain, {2, std::nullopt}, out);
    progress.update(1, 0.5);
    progress.finish(2, 1.0);
    EXPECT_EQ(out.str(), "");
}

TEST(ProgressReport, json_is_an_object_a_line)
{
    std::ostringstream out;
    Progress progress(ProgressMode::json, {4, std::nullopt}, out);
    progress.update(0, 0.0);
    progress.update(1, 2.0);
    progress.finish(4, 8.0);
    const auto lines = lines_of(out.str());
    ASSERT_EQ(lines.size(), 3u);
    const auto start = nlohmann::json::parse(lines[0]), middle = nlohmann::json::parse(lines[1]), end = nlohmann::json::parse(lines[2]);
    EXPECT_TRUE(start["seconds_left"].is_null());
    EXPECT_EQ(middle["iterations"], 1);
    EXPECT_EQ(middle["total_iterations"], 4);
    EXPECT_EQ(middle["fraction"], 0.25);
    EXPECT_EQ(middle["seconds_left"], 6.0);
    EXPECT_EQ(middle["iterations_per_second"], 0.5);
    EXPECT_EQ(end["fraction"], 1.0);
}

TEST(ProgressReport, whichever_goal_comes_first_counts)
{
    std::ostringstream out;
    Progress progress(ProgressMode::json, {100, 10.0}, out);
    progress.update(10, 5.0); // 10% of the iterations, 50% of the time
    const auto line = nlohmann::json::parse(out.str());
    EXPECT_EQ(line["fraction"], 0.5);
    EXPECT_EQ(line["seconds_left"], 5.0);
}

TEST(ProgressReport, an_error_that_falls_tells_when_it_is_small_enough)
{
    std::ostringstream out;
    Progress progress(ProgressMode::json, {std::nullopt, std::nullopt, 0, ErrorGoal{0.05, 0.5}}, out);
    progress.update(4, 2.0);
    progress.set_error(8, 0.1); // half of it takes four times as many iterations
    progress.update(16, 8.0);
    const auto lines = lines_of(out.str());
    const auto before = nlohmann::json::parse(lines.front()), after = nlohmann::json::parse(lines.back());
    EXPECT_TRUE(before["error"].is_null());
    EXPECT_EQ(before["target_error"], 0.05);
    EXPECT_TRUE(before["seconds_left"].is_null());
    EXPECT_EQ(after["error"], 0.1);
    EXPECT_NEAR(after["fraction"].get<double>(), 0.5, 1e-9);
    EXPECT_NEAR(after["seconds_left"].get<double>(), 8.0, 1e-9);

    for (const int columns : {80, 120}) {
        std::ostringstream bar;
        Progress drawn(ProgressMode::bar, {1000, std::nullopt, 0, ErrorGoal{0.05, 1.0 / 3}}, bar, columns);
        drawn.set_error(10, 0.1);
        drawn.update(20, 10.0);
        EXPECT_THAT(bar.str(), HasSubstr(" 25%  20/1000 iterations, 2.00/s, 0:10, 0:30 left, error 0.1 of 0.05")) << columns;
    }
}

TEST(ProgressReport, off_is_off)
{
    std::ostringstream out;
    Progress progress(ProgressMode::off, {4, std::nullopt}, out);
    progress.update(1, 5.0);
    progress.finish(4, 50.0);
    EXPECT_EQ(out.str(), "");
}

TEST(ProgressReport, a_message_takes_the_bar_off_first)
{
    std::ostringstream out;
    Progress progress(ProgressMode::bar, {10, std::nullopt}, out, 80);
    progress.update(5, 1.0);
    std::optional<BeforeLogLine> hook([&] { progress.clear(); });
    testing::internal::CaptureStderr();
    log_error("first line\nbuild log");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "sundog: error: first line (-v shows more)\n");
    EXPECT_THAT(out.str(), ::testing::EndsWith("\r\x1b[2K"));

    // Not once the display has ended.
    hook.reset();
    progress.update(6, 2.0);
    const std::string drawn = out.str();
    testing::internal::CaptureStderr();
    log_error("second line");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "sundog: error: second line\n");
    EXPECT_EQ(out.str(), drawn);
}

} // namespace
} // namespace sundog
