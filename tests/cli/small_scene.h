// A scene of a few pixels, whose parts tests replace one at a time.
#pragma once

#include <string>

namespace sundog::cli {

struct SmallScene {
    std::string integrator = R"(<integrator type="path"><integer name="max_depth" value="4"/></integrator>)";
    std::string film = R"(<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/><rfilter type="box"/></film>)";
    std::string sensor_start = R"(<sensor type="perspective"><float name="fov" value="45"/>
    <transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="2"/></sampler>)";
    std::string shape = R"(<shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.4, 0.3"/></bsdf></shape>)";
    std::string emitter = R"(<emitter type="point"><point name="position" x="0" y="0" z="3"/><rgb name="intensity" value="10, 10, 10"/></emitter>)";
    std::string extra;

    std::string xml() const
    {
        const std::string sensor = sensor_start.empty() ? "" : sensor_start + film + "</sensor>";
        std::string text = "<scene version=\"3.0.0\">\n";
        for (const std::string& part : {integrator, sensor, shape, emitter, extra}) text += part + "\n";
        return text + "</scene>\n";
    }
};

} // namespace sundog::cli
