// What moves in a scene file.
#pragma once

#include "import/object_reader.h"
#include "scene/shutter.h"

namespace sundog
{

// The object's to_world while the shutter is open, given by a <transform> or an <animation>: constant where nothing moves
// in that time, so that it costs nothing. It maps to the coordinates of the file. Warns, as notes, of an animation that no time is left
// for, and of half turns, whose way round is anybody's guess.
AnimatedTransform read_to_world(ObjectReader& reader, const Shutter& shutter);

} // namespace sundog
