// Parameters of bitmap textures and environment maps, in the spellings of 0.6 and 3.x.
#pragma once

#include "import/bitmap.h"
#include "import/object_reader.h"

namespace sundog
{

// filename, raw, gamma and channel. Throws SceneError.
BitmapRequest read_bitmap_request(ObjectReader& reader);

// 3.x has one mode, 0.6 one for both axes or one each.
void read_wrap_modes(ObjectReader& reader, BitmapTexture& bitmap);

TextureFilter read_texture_filter(ObjectReader& reader);

} // namespace sundog
