// Where a sensor is and where it looks.
#pragma once

#include "scene/scene.h"

namespace sundog
{

// Sets position and axes, whatever the lengths of to_world's axes are. What pose_of() makes of a sensor gives the same
// sensor, bit for bit.
void set_pose(const Transform& to_world, Sensor& sensor);

// Camera to world, without any scale.
Transform pose_of(const Sensor& sensor);

// The sensor as it is at a time.
Sensor sensor_at(const Sensor& sensor, double time);

} // namespace sundog
