// Times of events against the host's: what is wrong by a factor is found out, whichever way, and a busy host does not matter.
#include "device/event_clock.h"

#include <gtest/gtest.h>

namespace sundog
{
namespace
{

// A device whose clock shows `factor` for each second, and whose commands are said to take `busy` of the time; from 1000 s on the host.
bool is_trusted(double factor, double busy, double seconds, double late = 0.0)
{
    EventClock clock;
    clock.start(7.0, 1000.0);
    return clock.tells_seconds(7.0 + factor * seconds, 1000.0 + seconds + late, busy * factor * seconds);
}

TEST(EventClock, TrustsSeconds)
{
    for (const double seconds : {0.001, 0.6, 10.0, 1e5})
        for (const double busy : {0.0, 0.5, 1.0}) EXPECT_TRUE(is_trusted(1.0, busy, seconds)) << seconds << " s, busy for " << busy;
    EXPECT_TRUE(is_trusted(1.0, 0.9, 0.6, 0.1)) << "the host woke up late";
}

TEST(EventClock, FindsOtherUnits)
{
    for (const double factor : {1e-3, 0.012, 0.5, 1.5, 83.3, 1e3}) EXPECT_FALSE(is_trusted(factor, 0.3, 2.0)) << factor;
    EXPECT_FALSE(is_trusted(83.3, 0.3, 0.05)) << "longer than there was time, though that was short";
}

// Each of twenty commands is said to have taken as long as all of them.
TEST(EventClock, FindsTimesOfWholeBatches)
{
    EXPECT_FALSE(is_trusted(1.0, 20.0, 2.0));
    EXPECT_FALSE(is_trusted(1.0, 1.5, 2.0));
}

} // namespace
} // namespace sundog
