#include "import/texture_import.h"

#include "import/bitmap_settings.h"
#include "scene/texel_values.h"

namespace sundog
{

namespace
{

constexpr const char* supported_textures = "bitmap, checkerboard, mesh_attribute, scale";

// 3.x: to_uv; 0.6: scales, one for both axes or one each, and offsets.
void read_uv_transform(ObjectReader& reader, TextureDescription& texture)
{
    const Transform to_uv = reader.transform("to_uv");
    const double both = reader.number("uvscale", 1.0);
    const double scale_u = reader.number("uscale", both), scale_v = reader.number("vscale", both);
    const double offset_u = reader.number("uoffset", 0.0), offset_v = reader.number("voffset", 0.0);
    const auto row = [](const std::array<double, 4>& m, double scale, double offset) -> std::array<float, 3> {
        return {static_cast<float>(scale * m[0]), static_cast<float>(scale * m[1]), static_cast<float>(scale * m[3] + offset)};
    };
    texture.to_u = row(to_uv.m[0], scale_u, offset_u);
    texture.to_v = row(to_uv.m[1], scale_v, offset_v);
    if (reader.has("coordinates") && reader.text("coordinates", "uv") != "uv")
        throw SceneError(reader.where_of("coordinates"), "'coordinates' of a texture must be uv");
}

TextureRange range_of(ColorRole role)
{
    return role == ColorRole::reflectance ? TextureRange::unit : TextureRange::positive;
}

ColorRole role_of(TextureRange range)
{
    return range == TextureRange::unit ? ColorRole::reflectance : ColorRole::emission;
}

// A number, or the luminance of a colour in its place.
double gray_value(ObjectReader& reader, std::string_view name, double fallback)
{
    const XmlElement* value = reader.find(name);
    if (!value || value->tag == "float" || value->tag == "integer" || !is_color_tag(value->tag)) return reader.number(name, fallback);
    const Vec3 color = reader.color(name, {}, ColorRole::index);
    if (!(color.x == color.y && color.y == color.z))
        reader.index().warn(value->where, "'" + std::string(name) + "' is a number here: of the colour its luminance counts", WarningKind::approximated);
    return color.x == color.y && color.y == color.z ? color.x : luminance(color);
}

} // namespace

ColorSource TextureImporter::color(ObjectReader& reader, std::string_view name, Vec3 fallback, ColorRole role)
{
    if (const auto texture = reader.object(name, "texture")) {
        const ColorSource source = import(*texture->object, range_of(role));
        check_range(source);
        return source;
    }
    if (const auto daylight = textured_daylight(reader, name, range_of(role))) return *daylight;
    return reader.color(name, fallback, role);
}

std::optional<ColorSource> TextureImporter::textured_daylight(ObjectReader& reader, std::string_view name, TextureRange range)
{
    const XmlElement* value = reader.find(name);
    const std::string* type = value && value->tag == "spectrum" ? value->attribute("type") : nullptr;
    if (!type || *type != "d65") return {};
    ObjectReader daylight(*value, index_);
    const auto texture = daylight.object("color", "texture");
    if (!texture) return {};
    reader.object(name, "spectrum"); // asked for
    ColorSource source = import(*texture->object, range);
    source.value = source.value * static_cast<float>(daylight.number("scale", 1.0));
    daylight.finish();
    return source;
}

NumberSource TextureImporter::number(ObjectReader& reader, std::string_view name, double fallback, double least, double most)
{
    if (const auto texture = reader.object(name, "texture")) {
        const ColorSource source = import(*texture->object, TextureRange::positive);
        check_range(source);
        const float factor = luminance(source.value);
        return source.texture ? NumberSource(factor, *source.texture) : NumberSource(factor);
    }
    const double value = gray_value(reader, name, fallback);
    if (!(value >= least && value <= most)) {
        char range[80];
        std::snprintf(range, sizeof range, " must be between %g and %g, got %g", least, most, value);
        throw SceneError(reader.where_of(name), "'" + std::string(name) + "'" + range);
    }
    return static_cast<float>(value);
}

std::optional<ColorSource> TextureImporter::nested(ObjectReader& reader)
{
    const auto texture = reader.single("texture");
    if (!texture) return {};
    return import(*texture->object, TextureRange::any);
}

bool TextureImporter::is_gray(uint texture) const
{
    const auto gray = [](Vec3 color) { return color.x == color.y && color.y == color.z; };
    const auto& model = textures_.at(texture).model;
    if (const auto* bitmap = std::get_if<BitmapTexture>(&model)) {
        for (std::size_t i = 0; i < bitmap->image->texels.size(); i += bitmap->image->words_per_texel())
            if (!gray(linear_texel(bitmap->image->format, &bitmap->image->texels[i]))) return false;
    }
    if (const auto* board = std::get_if<CheckerboardTexture>(&model)) {
        for (const ColorSource& color : board->colors)
            if (!gray(color.value) || (color.texture && !is_gray(*color.texture))) return false;
    }
    return true;
}

double TextureImporter::aspect(uint texture) const
{
    const auto* bitmap = std::get_if<BitmapTexture>(&textures_.at(texture).model);
    return bitmap ? bitmaps_.aspect(*bitmap->image) : 1.0;
}

ColorSource TextureImporter::import(const XmlElement& element, TextureRange range)
{
    if (const auto found = imported_.find({&element, range}); found != imported_.end()) return found->second;
    if (!being_read_.insert(&element).second) throw SceneError(element.where, "this texture contains itself");
    const ColorSource source = read(element, range);
    being_read_.erase(&element);
    imported_[{&element, range}] = source;
    return source;
}

ColorSource TextureImporter::read(const XmlElement& element, TextureRange range)
{
    ObjectReader reader(element, index_);
    const std::string type = reader.type();
    ColorSource source;
    if (type == "bitmap")
        source = add(element, reader, range, read_bitmap(reader));
    else if (type == "checkerboard")
        source = add(element, reader, range, read_checkerboard(reader, range));
    else if (type == "mesh_attribute") {
        source = add(element, reader, range, AttributeTexture{reader.text("name", "")});
        source.value = source.value * static_cast<float>(reader.number("scale", 1.0));
    } else if (type == "scale")
        source = read_scale(reader, range);
    else {
        reader.missing(std::string("; supported are ") + supported_textures, "a grey of 0.5 stands in for it");
        source = ColorSource(Vec3{0.5f, 0.5f, 0.5f});
    }
    reader.finish();
    return source;
}

ColorSource TextureImporter::add(const XmlElement& element, ObjectReader& reader, TextureRange range, decltype(TextureDescription::model) model)
{
    TextureDescription texture;
    const std::string* id = element.attribute("id");
    texture.id = id ? *id : "";
    texture.where = element.where;
    texture.model = std::move(model);
    texture.range = range;
    read_uv_transform(reader, texture);
    textures_.push_back(std::move(texture));
    return {Vec3{1, 1, 1}, static_cast<uint>(textures_.size() - 1)};
}

BitmapTexture TextureImporter::read_bitmap(ObjectReader& reader)
{
    BitmapTexture bitmap;
    bitmap.image = bitmaps_.bitmap(read_bitmap_request(reader), reader.where_of("filename"));
    read_wrap_modes(reader, bitmap);
    bitmap.filter = read_texture_filter(reader);
    for (const char* name : {"accel", "format", "max_anisotropy", "cache"}) reader.ignore(name, "it does not change the image");
    return bitmap;
}

ColorSource TextureImporter::image(const std::filesystem::path& file, const SourceLocation& where, WrapMode wrap)
{
    TextureDescription texture;
    texture.where = where;
    texture.model = BitmapTexture{bitmaps_.bitmap({file, false, 0.0, {}}, where), wrap, wrap};
    texture.range = TextureRange::unit;
    textures_.push_back(std::move(texture));
    const ColorSource source{Vec3{1, 1, 1}, static_cast<uint>(textures_.size() - 1)};
    check_range(source);
    return source;
}

CheckerboardTexture TextureImporter::read_checkerboard(ObjectReader& reader, TextureRange range)
{
    CheckerboardTexture checkerboard;
    const Vec3 dark{0.4f, 0.4f, 0.4f}, light{0.2f, 0.2f, 0.2f};
    checkerboard.colors[0] = color(reader, "color0", dark, role_of(range));
    checkerboard.colors[1] = color(reader, "color1", light, role_of(range));
    return checkerboard;
}

ColorSource TextureImporter::read_scale(ObjectReader& reader, TextureRange range)
{
    const auto inside = reader.single("texture");
    if (!inside) throw SceneError(reader.where(), "a scale texture needs a <texture> inside");
    ColorSource source = import(*inside->object, range);
    const Vec3 factor = reader.color("scale", {1, 1, 1}, ColorRole::emission);
    source.value = source.value * factor;
    return source;
}

void TextureImporter::check_range(const ColorSource& source)
{
    if (!source.texture) return;
    const TextureDescription& texture = textures_[*source.texture];
    const auto* bitmap = std::get_if<BitmapTexture>(&texture.model);
    if (!bitmap || (is_of_bytes(bitmap->image->format) && max_component(source.value) <= 1.0f)) return;
    const std::size_t texels = bitmap->image->texels.size() / bitmap->image->words_per_texel();
    std::size_t below = 0, above = 0;
    for (std::size_t i = 0; i < texels; i++) {
        const Vec3 value = source.value * linear_texel(*bitmap->image, i);
        if (value.x < 0.0f || value.y < 0.0f || value.z < 0.0f) below++;
        if (texture.range == TextureRange::unit && max_component(value) > 1.0f) above++;
    }
    if (below + above == 0 || !checked_.insert(*source.texture).second) return;
    const std::string counts = std::to_string(below) + " of " + std::to_string(texels) + " texels are negative";
    index_.warn(texture.where,
                texture.range == TextureRange::unit
                    ? "values of the bitmap are outside of [0, 1], where energy is conserved, and were clamped: " + counts + ", " + std::to_string(above) + " above 1"
                    : "values of the bitmap are below 0 and count as 0: " + counts,
                WarningKind::approximated);
}

} // namespace sundog
