// Textures of a scene file, and parameters that may be one.
#pragma once

#include "import/bitmap_store.h"
#include "import/object_reader.h"
#include "scene/scene.h"

#include <map>
#include <set>

namespace sundog
{

// Appends to a scene's list of textures; an object that is used twice is imported once, and a file is read once.
class TextureImporter
{
public:
    // `budget`: bytes of all bitmaps together.
    TextureImporter(const SceneIndex& index, std::vector<TextureDescription>& textures, std::uint64_t budget)
        : index_(index), textures_(textures), bitmaps_(index, budget)
    {
    }

    BitmapStore& bitmaps() { return bitmaps_; }

    // A parameter that is a colour or a texture. Throws SceneError for plugins and values that are not supported.
    ColorSource color(ObjectReader& reader, std::string_view name, Vec3 fallback, ColorRole role);
    // A parameter that is a number or a texture, in [least, most].
    NumberSource number(ObjectReader& reader, std::string_view name, double fallback, double least, double most);

    // An image file without a plugin of its own, its settings as bitmap's; `where`: of what wants it. Throws SceneError for
    // an unreadable file.
    ColorSource image(const std::filesystem::path& file, const SourceLocation& where, WrapMode wrap);

    // The one texture inside, whatever its name. Throws SceneError for more.
    std::optional<ColorSource> nested(ObjectReader& reader);
    // Whether it has the same red, green and blue everywhere; mesh attributes count as if they had.
    bool is_gray(uint texture) const;
    // Width over height of an image, 1 of other textures.
    double aspect(uint texture) const;

private:
    // A texture once for each range that it is wanted in.
    using Use = std::pair<const XmlElement*, TextureRange>;

    // <spectrum type="d65"> whose colour is a texture.
    std::optional<ColorSource> textured_daylight(ObjectReader& reader, std::string_view name, TextureRange range);
    // The texture, and what its value has to be multiplied by (0.6's <texture type="scale">).
    ColorSource import(const XmlElement& element, TextureRange range);
    ColorSource read(const XmlElement& element, TextureRange range);
    ColorSource add(const XmlElement& element, ObjectReader& reader, TextureRange range, decltype(TextureDescription::model) model);
    BitmapTexture read_bitmap(ObjectReader& reader);
    CheckerboardTexture read_checkerboard(ObjectReader& reader, TextureRange range);
    ColorSource read_scale(ObjectReader& reader, TextureRange range);
    // Warns where texels times the factor are out of the texture's range.
    void check_range(const ColorSource& source);

    const SceneIndex& index_;
    std::vector<TextureDescription>& textures_;
    BitmapStore bitmaps_;
    std::map<Use, ColorSource> imported_;
    std::set<const XmlElement*> being_read_;
    std::set<uint> checked_; // textures with a warning
};

} // namespace sundog
