#include "scene/sensor_pose.h"

#include "math/direction.h"

namespace sundog
{

namespace
{

void set_column(Transform& t, std::size_t j, Vec3 v)
{
    t.m[0][j] = v.x;
    t.m[1][j] = v.y;
    t.m[2][j] = v.z;
}

} // namespace

void set_pose(const Transform& to_world, Sensor& sensor)
{
    sensor.position = to_world.point({0, 0, 0});
    sensor.axis_z = direction_of(to_world.vector({0, 0, 1}));
    sensor.axis_y = direction_of(to_world.vector({0, 1, 0}));
    constexpr float rounding = 1e-6f; // of the cosine of axes that are perpendicular
    if (const float lean = dot(sensor.axis_y, sensor.axis_z); std::abs(lean) > rounding)
        sensor.axis_y = direction_of(sensor.axis_y - sensor.axis_z * lean);
    // A reflection in to_world mirrors the image.
    const Vec3 x = cross(sensor.axis_y, sensor.axis_z);
    sensor.axis_x = to_world.determinant() < 0.0 ? -x : x;
}

Transform pose_of(const Sensor& sensor)
{
    Transform to_world;
    set_column(to_world, 0, sensor.axis_x);
    set_column(to_world, 1, sensor.axis_y);
    set_column(to_world, 2, sensor.axis_z);
    set_column(to_world, 3, sensor.position);
    return to_world;
}

Sensor sensor_at(const Sensor& sensor, double time)
{
    Sensor moved = sensor;
    if (sensor.motion) set_pose(sensor.motion->at(time), moved);
    return moved;
}

} // namespace sundog
