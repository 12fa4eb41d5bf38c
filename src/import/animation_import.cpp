#include "import/animation_import.h"

#include "import/number_text.h"

namespace sundog
{

AnimatedTransform read_to_world(ObjectReader& reader, const Shutter& shutter)
{
    AnimatedTransform to_world = reader.animation("to_world");
    const auto warn = [&](const std::string& text) { reader.index().warn(reader.where_of("to_world"), text); };
    if (!to_world.is_constant() && !(shutter.open < shutter.close))
        warn(reader.describe() + " stands still: the shutter is open for no time; give the sensor a shutter_close after its shutter_open");
    if (!to_world.moves(shutter.open, shutter.close)) return to_world.at(shutter.open);
    if (const auto times = to_world.ambiguous_turn())
        warn(reader.describe() + " turns by 180 degrees between the times " + number_text(times->first) + " and " +
             number_text(times->second) + ", which is as far either way: add a key between them to say which");
    return to_world;
}

} // namespace sundog
