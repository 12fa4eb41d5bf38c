// Quantiles of the chi-squared distribution against published tables.
#include "math/chi_squared.h"
#include "support/chi_squared.h"

namespace sundog
{
namespace
{

TEST(ChiSquaredQuantile, IsThatOfTables)
{
    // [Abramowitz and Stegun 1964, table 26.8]
    EXPECT_NEAR(chi_squared_quantile(0.05, 5), 11.0705, 5e-5);
    EXPECT_NEAR(chi_squared_quantile(0.05, 11), 19.6751, 5e-5);
    EXPECT_NEAR(chi_squared_quantile(0.001, 11), 31.264, 5e-4);
    EXPECT_NEAR(chi_squared_quantile(0.5, 1), 0.4549364, 5e-8);
}

TEST(ChiSquaredQuantile, InvertsTheTail)
{
    for (const int degrees : {1, 3, 5, 11}) {
        for (const double tail : {0.9, 0.1, 1e-3, 1e-9}) {
            const double quantile = chi_squared_quantile(tail, degrees);
            EXPECT_NEAR(chi_squared_tail(quantile, degrees) / tail, 1.0, 1e-9) << degrees << " " << tail;
            EXPECT_NEAR(chi_squared_p_value(quantile, degrees) / tail, 1.0, 1e-6) << degrees << " " << tail;
        }
    }
}

} // namespace
} // namespace sundog
