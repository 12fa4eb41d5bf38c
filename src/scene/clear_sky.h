// Radiance of a clear sky [Hosek and Wilkie 2012, An Analytic Model for Full Spectral Sky-Dome Radiance] and of the sun that
// shines through it [Hosek and Wilkie 2013, Adding a Solar-Radiance Function to the Hosek-Wilkie Skylight Model]: linear
// sRGB, W/m^2/sr/nm as Mitsuba has it, so that white of luminance 1 is (1, 1, 1).
#pragma once

#include "math/vec3.h"

#include <array>
#include <vector>

namespace sundog
{

// Half the angle under which the sun is seen (rad), for which the model was fitted.
constexpr double sun_half_angle = 0.5 * 0.5358 * 3.14159265358979323846 / 180.0;

class ClearSky
{
public:
    // turbidity: 1 to 10. albedo: of the ground, 0 to 1 in each channel. sun_elevation: above the horizon (rad), 0 to pi / 2.
    ClearSky(double turbidity, Vec3 albedo, double sun_elevation);

    // Of the sky, in a direction of this cosine to the zenith (>= 0) that is `gamma` (rad) away from the sun.
    Vec3 sky(double cos_zenith, double gamma) const;

    // Of the sun's disk, seen at an elevation (rad, >= 0), at a point of its surface whose normal has the cosine cos_psi to the
    // line of sight: 1 in the middle of the disk, 0 at its limb.
    Vec3 sun(double elevation, double cos_psi) const;

private:
    struct Channel {
        std::array<double, 9> parameters; // A to I of eq. 8
        double radiance;
    };
    std::array<Channel, 3> channels_;
    std::vector<double> sun_; // by segment, channel, power, limb power
};

} // namespace sundog
