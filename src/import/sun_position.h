// Where the sun stands [Blanco-Muriel et al. 2001, Computing the Solar Vector], right to half a minute of arc.
#pragma once

namespace sundog
{

struct PlaceAndTime {
    double latitude = 35.6894;   // degrees north: Tokyo, a summer afternoon, as in Mitsuba
    double longitude = 139.6917; // degrees east
    double timezone = 9.0;       // hours ahead of universal time
    int year = 2010;
    int month = 7;
    int day = 10;
    double hour = 15.0;
    double minute = 0.0;
    double second = 0.0;
};

struct SunPosition {
    double polar_angle = 0.0; // to the zenith (rad)
    double azimuth = 0.0;     // from north over east (rad), 0 to 2 pi
};

SunPosition sun_position(const PlaceAndTime& when);

} // namespace sundog
