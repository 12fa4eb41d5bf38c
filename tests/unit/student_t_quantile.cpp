// Quantiles of Student's t distribution against published tables and another way to compute them.
#include "math/student_t.h"
#include "support/render_replicates.h"

#include <gtest/gtest.h>

namespace sundog
{
namespace
{

TEST(StudentTQuantile, IsThatOfTables)
{
    // [Abramowitz and Stegun 1964, table 26.10]
    EXPECT_NEAR(student_t_quantile(0.05, 1), 6.314, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.05, 7), 1.895, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.025, 30), 2.042, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.005, 120), 2.617, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.05, 1e6), 1.645, 5e-4);
    EXPECT_NEAR(student_t_quantile(0.5, 3), 0.0, 1e-12);
}

TEST(StudentTQuantile, InvertsTheTailAndAgreesWithItsIntegral)
{
    for (const double degrees : {1.0, 2.0, 7.0, 63.0, 4095.0})
        for (const double tail : {0.4, 0.05, 1e-3}) {
            const double quantile = student_t_quantile(tail, degrees);
            EXPECT_NEAR(student_t_tail(quantile, degrees) / tail, 1.0, 1e-9) << degrees << " " << tail;
            if (degrees > 1.0) {
                EXPECT_NEAR(quantile / test::student_quantile(degrees, tail), 1.0, 1e-4) << degrees << " " << tail;
            }
        }
}

} // namespace
} // namespace sundog
