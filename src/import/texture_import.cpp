#include "import/texture_import.h"

#include "import/bitmap.h"

namespace sundog
{

namespace
{

constexpr const char* supported_textures = "bitmap, checkerboard, mesh_attribute, scale";

WrapMode read_wrap_mode(ObjectReader& reader, const char* name, const std::string& fallback)
{
    const std::string mode = reader.text(name, fallback);
    if (mode == "repeat") return WrapMode::repeat;
    if (mode == "mirror") return WrapMode::mirror;
    if (mode == "clamp") return WrapMode::clamp;
    throw SceneError(reader.where_of(name), "'" + std::string(name) + "' must be repeat, mirror or clamp, got '" + mode + "'");
}

// 3.x has one mode, 0.6 one for all or one an axis.
WrapMode read_wrap(ObjectReader& reader)
{
    const std::string both = reader.has("wrap_mode") ? reader.text("wrap_mode", "repeat") : "repeat";
    if (reader.has("wrap_mode")) return read_wrap_mode(reader, "wrap_mode", "repeat");
    const WrapMode u = read_wrap_mode(reader, "wrap_mode_u", both), v = read_wrap_mode(reader, "wrap_mode_v", both);
    if (u != v) throw SceneError(reader.where_of("wrap_mode_v"), "different wrap modes along u and v are not supported: give both the same");
    return u;
}

TextureFilter read_filter(ObjectReader& reader)
{
    const std::string filter = reader.text("filter_type", "bilinear");
    if (filter == "nearest") return TextureFilter::nearest;
    if (filter == "ewa" || filter == "trilinear")
        reader.index().warn(reader.where_of("filter_type"), "filter '" + filter + "' is done as bilinear: many samples a pixel average the texture",
                              WarningKind::approximated);
    else if (filter != "bilinear")
        throw SceneError(reader.where_of("filter_type"), "'filter_type' must be nearest or bilinear, got '" + filter + "'");
    return TextureFilter::bilinear;
}

// 3.x: to_uv; 0.6: scales and offsets.
void read_uv_transform(ObjectReader& reader, TextureDescription& texture)
{
    const Transform to_uv = reader.transform("to_uv");
    const double scale_u = reader.number("uscale", 1.0), scale_v = reader.number("vscale", 1.0);
    const double offset_u = reader.number("uoffset", 0.0), offset_v = reader.number("voffset", 0.0);
    const auto row = [](const std::array<double, 4>& m, double scale, double offset) -> std::array<float, 3> {
        return {static_cast<float>(scale * m[0]), static_cast<float>(scale * m[1]), static_cast<float>(scale * m[3] + offset)};
    };
    texture.to_u = row(to_uv.m[0], scale_u, offset_u);
    texture.to_v = row(to_uv.m[1], scale_v, offset_v);
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
    if (const auto texture = reader.object(name, "texture")) return import(*texture->object);
    if (const auto daylight = textured_daylight(reader, name)) return *daylight;
    return reader.color(name, fallback, role);
}

std::optional<ColorSource> TextureImporter::textured_daylight(ObjectReader& reader, std::string_view name)
{
    const XmlElement* value = reader.find(name);
    const std::string* type = value && value->tag == "spectrum" ? value->attribute("type") : nullptr;
    if (!type || *type != "d65") return {};
    ObjectReader daylight(*value, index_);
    const auto texture = daylight.object("color", "texture");
    if (!texture) return {};
    reader.object(name, "spectrum"); // asked for
    ColorSource source = import(*texture->object);
    source.value = source.value * static_cast<float>(daylight.number("scale", 1.0));
    daylight.finish();
    return source;
}

NumberSource TextureImporter::number(ObjectReader& reader, std::string_view name, double fallback, double least, double most)
{
    if (const auto texture = reader.object(name, "texture")) {
        const ColorSource source = import(*texture->object);
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
    return import(*texture->object);
}

double TextureImporter::aspect(uint texture) const
{
    return textures_.at(texture).aspect();
}

ColorSource TextureImporter::import(const XmlElement& element)
{
    if (const auto found = imported_.find(&element); found != imported_.end()) return found->second;
    imported_[&element] = ColorSource(Vec3{0, 0, 0}); // for a texture inside itself; replaced below
    ObjectReader reader(element, index_);
    const std::string type = reader.type();
    ColorSource source;
    if (type == "bitmap")
        source = add(element, reader, read_bitmap(reader));
    else if (type == "checkerboard")
        source = add(element, reader, read_checkerboard(reader));
    else if (type == "mesh_attribute") {
        source = add(element, reader, AttributeTexture{reader.text("name", "")});
        source.value = source.value * static_cast<float>(reader.number("scale", 1.0));
    } else if (type == "scale")
        source = read_scale(reader);
    else {
        reader.missing(std::string("; supported are ") + supported_textures, "a grey of 0.5 stands in for it");
        source = ColorSource(Vec3{0.5f, 0.5f, 0.5f});
    }
    reader.finish();
    imported_[&element] = source;
    return source;
}

ColorSource TextureImporter::add(const XmlElement& element, ObjectReader& reader, decltype(TextureDescription::model) model)
{
    TextureDescription texture;
    const std::string* id = element.attribute("id");
    texture.id = id ? *id : "";
    texture.where = element.where;
    texture.model = std::move(model);
    read_uv_transform(reader, texture);
    textures_.push_back(std::move(texture));
    return {Vec3{1, 1, 1}, static_cast<uint>(textures_.size() - 1)};
}

BitmapTexture TextureImporter::read_bitmap(ObjectReader& reader)
{
    BitmapTexture bitmap;
    const auto file = index_.find_file(reader.text("filename", ""), reader.where_of("filename"));
    // 0.6 says by `gamma` what 3.x says by `raw`: 1 is linear, -1 what the file is.
    const double gamma = reader.number("gamma", -1.0);
    if (gamma != -1.0 && gamma != 1.0 && gamma != 2.2)
        throw SceneError(reader.where_of("gamma"), "'gamma' of a bitmap must be 1 (linear) or -1 (as the file says): convert the image");
    const bool raw = reader.boolean("raw", gamma == 1.0);
    bitmap.image = texels(file, reader.where_of("filename"), raw);
    bitmap.wrap = read_wrap(reader);
    bitmap.filter = read_filter(reader);
    for (const char* name : {"accel", "format", "max_anisotropy", "cache", "channel"}) reader.ignore(name, "it does not change the image");
    return bitmap;
}

std::shared_ptr<const TexelImage> TextureImporter::texels(const std::filesystem::path& file, const SourceLocation& where, bool raw)
{
    if (const auto found = images_.find({file, raw}); found != images_.end()) return found->second;
    bool replaced = false;
    auto image = std::make_shared<const TexelImage>(load_bitmap(file, where, raw, replaced));
    if (replaced)
        index_.warn(where, "values of '" + file.string() + "' that are not finite were replaced: NaN by 0, infinity by 65504", WarningKind::approximated);
    images_[{file, raw}] = image;
    return image;
}

ColorSource TextureImporter::image(const std::filesystem::path& file, const SourceLocation& where, WrapMode wrap)
{
    TextureDescription texture;
    texture.where = where;
    texture.model = BitmapTexture{texels(file, where, false), wrap};
    textures_.push_back(std::move(texture));
    return {Vec3{1, 1, 1}, static_cast<uint>(textures_.size() - 1)};
}

CheckerboardTexture TextureImporter::read_checkerboard(ObjectReader& reader)
{
    CheckerboardTexture checkerboard;
    const Vec3 dark{0.4f, 0.4f, 0.4f}, light{0.2f, 0.2f, 0.2f};
    checkerboard.colors[0] = color(reader, "color0", dark, ColorRole::reflectance);
    checkerboard.colors[1] = color(reader, "color1", light, ColorRole::reflectance);
    return checkerboard;
}

ColorSource TextureImporter::read_scale(ObjectReader& reader)
{
    const auto inside = reader.single("texture");
    if (!inside) throw SceneError(reader.where(), "a scale texture needs a <texture> inside");
    ColorSource source = import(*inside->object);
    const Vec3 factor = reader.color("scale", {1, 1, 1}, ColorRole::emission);
    source.value = source.value * factor;
    return source;
}

} // namespace sundog
