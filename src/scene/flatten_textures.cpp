#include "scene/flatten_textures.h"

#include "scene/flatten_bsdfs.h"

#include <algorithm>
#include <limits>
#include <map>

namespace sundog {

namespace {

// Distinct names, in the order of their first texture.
std::vector<std::string> attribute_names(const Scene& scene)
{
    std::vector<std::string> names;
    for (const auto& texture : scene.textures) {
        const auto* attribute = std::get_if<AttributeTexture>(&texture.model);
        if (attribute && std::find(names.begin(), names.end(), attribute->name) == names.end()) names.push_back(attribute->name);
    }
    return names;
}

class TextureFlattener
{
public:
    TextureFlattener(const Scene& scene, FlatScene& flat) : scene_(scene), flat_(flat), names_(attribute_names(scene)) {}

    void run()
    {
        for (const auto& description : scene_.textures) {
            Texture texture{};
            std::copy(description.to_u.begin(), description.to_u.end(), texture.to_u);
            std::copy(description.to_v.begin(), description.to_v.end(), texture.to_v);
            texture.range = static_cast<uint>(description.range);
            where_ = &description.where;
            std::visit([&](const auto& model) { fill(model, texture); }, description.model);
            flat_.textures.push_back(texture);
        }
    }

private:
    void fill(const BitmapTexture& bitmap, Texture& texture)
    {
        const TexelImage& image = *bitmap.image;
        texture.type = TEXTURE_BITMAP;
        texture.width = static_cast<uint>(image.width);
        texture.height = static_cast<uint>(image.height);
        texture.format = static_cast<uint>(image.format);
        texture.wrap_u = static_cast<uint>(bitmap.wrap_u);
        texture.wrap_v = static_cast<uint>(bitmap.wrap_v);
        texture.filter = static_cast<uint>(bitmap.filter);
        texture.first_texel = store(image);
    }

    void fill(const CheckerboardTexture& checkerboard, Texture& texture)
    {
        texture.type = TEXTURE_CHECKERBOARD;
        texture.colors[0] = flatten(checkerboard.colors[0]);
        texture.colors[1] = flatten(checkerboard.colors[1]);
    }

    void fill(const AttributeTexture& attribute, Texture& texture)
    {
        texture.type = TEXTURE_ATTRIBUTE;
        texture.attribute = static_cast<uint>(std::find(names_.begin(), names_.end(), attribute.name) - names_.begin());
    }

    uint store(const TexelImage& image)
    {
        const auto [entry, added] = stored_.emplace(&image, static_cast<uint>(flat_.texels.size()));
        if (!added) return entry->second;
        if (flat_.texels.size() + image.texels.size() > std::numeric_limits<uint>::max())
            throw SceneError(*where_, "the textures hold more texels than 32-bit numbers can count: scale some down");
        flat_.texels.insert(flat_.texels.end(), image.texels.begin(), image.texels.end());
        return entry->second;
    }

    const Scene& scene_;
    FlatScene& flat_;
    std::vector<std::string> names_;
    std::map<const TexelImage*, uint> stored_;
    const SourceLocation* where_ = nullptr;
};

} // namespace

void flatten_textures(const Scene& scene, FlatScene& flat)
{
    static_assert(static_cast<uint>(TexelFormat::half) == TEXELS_HALF && static_cast<uint>(TexelFormat::linear8) == TEXELS_LINEAR &&
                  static_cast<uint>(TexelFormat::float32) == TEXELS_FLOAT);
    static_assert(static_cast<uint>(WrapMode::mirror) == WRAP_MIRROR && static_cast<uint>(WrapMode::clamp) == WRAP_CLAMP);
    static_assert(static_cast<uint>(WrapMode::zero) == WRAP_ZERO && static_cast<uint>(WrapMode::one) == WRAP_ONE);
    static_assert(static_cast<uint>(TextureRange::positive) == RANGE_POSITIVE && static_cast<uint>(TextureRange::unit) == RANGE_UNIT);
    static_assert(static_cast<uint>(TextureFilter::bilinear) == FILTER_BILINEAR);
    TextureFlattener(scene, flat).run();
}

void list_attributes(const Scene& scene, FlatScene& flat)
{
    const std::vector<std::string> names = attribute_names(scene);
    flat.globals.attribute_count = static_cast<uint>(names.size());
    for (std::size_t s = 0; s < scene.shapes.size() && !names.empty(); s++) {
        const Shape& shape = flat.shapes[s];
        const auto* mesh = std::get_if<TriangleMesh>(&scene.shapes[s].geometry);
        for (const std::string& name : names) {
            AttributeRange range{0, NO_ATTRIBUTE};
            for (const MeshAttribute& attribute : mesh ? mesh->attributes : std::vector<MeshAttribute>{}) {
                if (attribute.name != name) continue;
                // Vertex and primitive numbers are those of the whole scene; the sum wraps round.
                const uint first = attribute.per_face ? shape.first_primitive : flat.triangles[shape.first_primitive].vertex[0] - mesh->triangles[0][0];
                range = {static_cast<uint>(flat.attribute_values.size()) - first, attribute.per_face ? ATTRIBUTE_PER_FACE : ATTRIBUTE_PER_VERTEX};
                flat.attribute_values.insert(flat.attribute_values.end(), attribute.values.begin(), attribute.values.end());
            }
            flat.attribute_ranges.push_back(range);
        }
    }
}

} // namespace sundog
