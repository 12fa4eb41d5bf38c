#include "import/texture_writer.h"

#include "import/preimage.h"

namespace sundog
{

namespace
{

const char* name_of(WrapMode mode)
{
    switch (mode) {
    case WrapMode::repeat:
        return "repeat";
    case WrapMode::mirror:
        return "mirror";
    case WrapMode::clamp:
        return "clamp";
    case WrapMode::zero:
        return "zero";
    case WrapMode::one:
        return "one";
    }
    throw std::logic_error("a wrap mode that cannot be written");
}

constexpr std::array<float, 3> same_u{1, 0, 0}, same_v{0, 1, 0};

// A scale of 0 along an axis, which 0.6's uscale allows, cannot be part of a matrix.
void write_uv_transform(ObjectWriter object, const TextureDescription& texture)
{
    if (texture.to_u == same_u && texture.to_v == same_v) return;
    Transform to_uv;
    const auto set_row = [&](std::size_t row, const std::array<float, 3>& map, const char* scale, const char* offset) {
        if (map[0] == 0.0f && map[1] == 0.0f) {
            object.number(scale, 0.0);
            object.number(offset, map[2]);
        } else {
            to_uv.m[row] = {map[0], map[1], 0.0, map[2]};
        }
    };
    set_row(0, texture.to_u, "uscale", "uoffset");
    set_row(1, texture.to_v, "vscale", "voffset");
    object.transform("to_uv", to_uv);
}

// A colour of the luminance, to the last bit: a gray, or one with a little more or less blue, which counts least.
Vec3 color_of_luminance(float wanted)
{
    const auto matches = [&](float gray) { return luminance({gray, gray, gray}) == wanted; };
    if (const auto gray = find_near(wanted, matches)) return {*gray, *gray, *gray};
    const auto blue = find_near(
        wanted,
        [&](float b) {
            return luminance({wanted, wanted, b}) == wanted;
        },
        1000);
    if (!blue) throw std::logic_error("no colour has the luminance " + std::to_string(wanted));
    return {wanted, wanted, *blue};
}

} // namespace

TextureWriter::TextureWriter(const Scene& scene, WrittenIds& ids, WrittenFiles& files) : scene_(scene), files_(files), used_(scene.textures.size())
{
    for (std::size_t i = 0; i < scene.textures.size(); i++) ids_.push_back(ids.add(scene.textures[i].id, "texture", i));
}

void TextureWriter::write_all(ObjectWriter root)
{
    for (std::size_t i = 0; i < scene_.textures.size(); i++) {
        const TextureDescription& texture = scene_.textures[i];
        std::visit([&](const auto& model) { write(root, ids_[i], texture, model); }, texture.model);
    }
}

void TextureWriter::check_all_used() const
{
    for (std::size_t i = 0; i < used_.size(); i++)
        if (!used_[i])
            throw SceneError(scene_.textures[i].where,
                             "--dump cannot write a texture of nothing but lights that emit nothing: remove the texture, or those lights");
}

void TextureWriter::write(ObjectWriter root, const std::string& id, const TextureDescription& texture, const BitmapTexture& bitmap)
{
    ObjectWriter object = root.object("texture", "bitmap", "", id);
    object.text("filename", files_.add_image(bitmap.image));
    object.boolean("raw", bitmap.image->format != TexelFormat::srgb8);
    if (bitmap.wrap_u == bitmap.wrap_v) {
        object.text("wrap_mode", name_of(bitmap.wrap_u));
    } else {
        object.text("wrap_mode_u", name_of(bitmap.wrap_u));
        object.text("wrap_mode_v", name_of(bitmap.wrap_v));
    }
    object.text("filter_type", bitmap.filter == TextureFilter::nearest ? "nearest" : "bilinear");
    write_uv_transform(object, texture);
}

void TextureWriter::write(ObjectWriter root, const std::string& id, const TextureDescription& texture,
                          const CheckerboardTexture& checkerboard)
{
    ObjectWriter object = root.object("texture", "checkerboard", "", id);
    color(object, "color0", checkerboard.colors[0]);
    color(object, "color1", checkerboard.colors[1]);
    write_uv_transform(object, texture);
}

void TextureWriter::write(ObjectWriter root, const std::string& id, const TextureDescription& texture, const AttributeTexture& attribute)
{
    ObjectWriter object = root.object("texture", "mesh_attribute", "", id);
    object.text("name", attribute.name);
    write_uv_transform(object, texture);
}

void TextureWriter::scaled(ObjectWriter object, const char* name, uint texture, Vec3 factor) const
{
    used_[texture] = true;
    if (factor == Vec3{1, 1, 1}) {
        object.reference(ids_[texture], name);
        return;
    }
    ObjectWriter scale = object.object("texture", "scale", name);
    scale.reference(ids_[texture]);
    scale.color("scale", factor);
}

void TextureWriter::color(ObjectWriter object, const char* name, const ColorSource& source) const
{
    if (source.texture)
        scaled(object, name, *source.texture, source.value);
    else
        object.color(name, source.value);
}

void TextureWriter::number(ObjectWriter object, const char* name, const NumberSource& source) const
{
    if (!source.texture)
        object.number(name, source.value);
    else if (source.value == luminance({1, 1, 1}))
        scaled(object, name, *source.texture, {1, 1, 1});
    else
        scaled(object, name, *source.texture, color_of_luminance(source.value));
}

} // namespace sundog
