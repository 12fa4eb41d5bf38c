#include "stages/scene_motion.h"

#include "scene/sensor_pose.h"

namespace sundog
{

void SceneMotion::begin_pass(std::uint64_t pass)
{
    if (!moves_) return;
    const double time = pass_time(scene_.sensor.shutter, seed_, pass);
    device_scene_.set_time(time);
    camera_ = make_camera(sensor_at(scene_.sensor, time), scene_.film);
}

} // namespace sundog
