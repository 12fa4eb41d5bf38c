// Textures of a scene file, and parameters that may be one.
#pragma once

#include "import/object_reader.h"
#include "scene/scene.h"

#include <map>

namespace sundog
{

// Appends to a scene's list of textures; an object that is used twice is imported once, and a file is read once.
class TextureImporter
{
public:
    TextureImporter(const SceneIndex& index, std::vector<TextureDescription>& textures) : index_(index), textures_(textures) {}

    // A parameter that is a colour or a texture. Throws SceneError for plugins and values that are not supported.
    ColorSource color(ObjectReader& reader, std::string_view name, Vec3 fallback, ColorRole role);
    // A parameter that is a number or a texture, in [least, most].
    NumberSource number(ObjectReader& reader, std::string_view name, double fallback, double least, double most);

    // An image file without a plugin of its own, its settings as bitmap's; `where`: of what wants it. Throws SceneError for
    // an unreadable file.
    ColorSource image(const std::filesystem::path& file, const SourceLocation& where, WrapMode wrap);

    // The one texture inside, whatever its name. Throws SceneError for more.
    std::optional<ColorSource> nested(ObjectReader& reader);
    // Width over height of an image, 1 of other textures.
    double aspect(uint texture) const;

private:
    // <spectrum type="d65"> whose colour is a texture.
    std::optional<ColorSource> textured_daylight(ObjectReader& reader, std::string_view name);
    // The texture, and what its value has to be multiplied by (0.6's <texture type="scale">).
    ColorSource import(const XmlElement& element);
    ColorSource add(const XmlElement& element, ObjectReader& reader, decltype(TextureDescription::model) model);
    BitmapTexture read_bitmap(ObjectReader& reader);
    std::shared_ptr<const TexelImage> texels(const std::filesystem::path& file, const SourceLocation& where, bool raw);
    CheckerboardTexture read_checkerboard(ObjectReader& reader);
    ColorSource read_scale(ObjectReader& reader);

    const SceneIndex& index_;
    std::vector<TextureDescription>& textures_;
    std::map<const XmlElement*, ColorSource> imported_;
    std::map<std::pair<std::filesystem::path, bool>, std::shared_ptr<const TexelImage>> images_; // by file, and whether raw
};

} // namespace sundog
