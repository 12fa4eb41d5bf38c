#include "import/limits.h"

#include "import/number_text.h"

#include <cmath>

namespace sundog
{

void check_position(Vec3 position, const SourceLocation& where, const std::string& what)
{
    for (const float c : {position.x, position.y, position.z})
        if (!(std::abs(c) <= largest_coordinate))
            throw SceneError(where, "the position of " + what + " has a coordinate beyond 1e12: scale the scene down");
}

void check_relative_index(float eta, const SourceLocation& where)
{
    constexpr float least = 0.999999f / static_cast<float>(largest_relative_index),
                    most = 1.000001f * static_cast<float>(largest_relative_index);
    if (eta >= least && eta <= most) return;
    throw SceneError(where, "the index of refraction inside over that outside must be between 0.01 and 100, got " + number_text(eta));
}

void check_emission(Vec3 emission, const SourceLocation& where, const std::string& name)
{
    if (max_component(emission) > largest_emission)
        throw SceneError(where, "'" + name + "' must be at most 1e18, got " + number_text(max_component(emission)));
}

} // namespace sundog
