#include "import/sun_position.h"

#include <chrono>
#include <cmath>
#include <numbers>

namespace sundog
{

namespace
{

constexpr double pi = std::numbers::pi, degree = pi / 180.0;

double universal_hours(const PlaceAndTime& when)
{
    return when.hour - when.timezone + (when.minute + when.second / 60.0) / 60.0;
}

// Since noon of 1 January 2000, universal time.
double elapsed_days(const PlaceAndTime& when)
{
    using namespace std::chrono;
    // A day or month beyond the calendar's goes on into the next month or year.
    const sys_days month_begin = sys_days((year_month(year(when.year), January) + months(when.month - 1)) / 1);
    const sys_days noon_2000 = sys_days(year(2000) / January / 1);
    return static_cast<double>((month_begin - noon_2000).count()) + when.day - 1 - 0.5 + universal_hours(when) / 24.0;
}

} // namespace

SunPosition sun_position(const PlaceAndTime& when)
{
    const double days = elapsed_days(when);
    // Along the ecliptic.
    const double omega = 2.1429 - 0.0010394594 * days;
    const double anomaly = 6.2400600 + 0.0172019699 * days;
    const double longitude = 4.8950630 + 0.017202791698 * days + 0.03341607 * std::sin(anomaly) + 0.00034894 * std::sin(2.0 * anomaly) -
                             0.0001134 - 0.0000203 * std::sin(omega);
    const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);
    // Along the celestial equator.
    const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
    // Above the horizon.
    const double sidereal_hours = 6.6974243242 + 0.0657098283 * days + universal_hours(when);
    const double hour_angle = (sidereal_hours * 15.0 + when.longitude) * degree - right_ascension;
    const double latitude = when.latitude * degree;
    const double cosine = std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) + std::sin(declination) * std::sin(latitude);
    const double seen_from_centre = std::acos(std::fmin(std::fmax(cosine, -1.0), 1.0));
    const double azimuth =
        std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) - std::sin(latitude) * std::cos(hour_angle));

    constexpr double parallax = 6371.01 / 149597890.0; // the earth's radius over its distance
    return {seen_from_centre + parallax * std::sin(seen_from_centre), azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth};
}

} // namespace sundog
