#include "import/obj_materials.h"

#include "import/text_file.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <tiny_obj_loader.h>

namespace sundog
{

namespace
{

// Libraries written on Windows separate folders by backslashes.
std::filesystem::path image_beside(const std::filesystem::path& library, std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    return (library.parent_path() / name).lexically_normal();
}

// Whether options scale, move or stir the image.
bool places_image(const tinyobj::texture_option_t& options)
{
    const auto is = [](const tinyobj::real_t (&values)[3], tinyobj::real_t standard) {
        return std::all_of(std::begin(values), std::end(values), [&](tinyobj::real_t value) { return value == standard; });
    };
    return !is(options.scale, 1) || !is(options.origin_offset, 0) || !is(options.turbulence, 0);
}

void append_library(const std::filesystem::path& file, ObjFile& result)
{
    const std::string text = read_text_file(file, {});
    std::istringstream stream{std::string(without_byte_order_mark(text, {file.string(), 0}))};
    std::map<std::string, int> numbers;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    tinyobj::LoadMtl(&numbers, &materials, &stream, &warning, &error);
    std::istringstream lines(warning);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) result.warnings.push_back(line);
    for (const auto& material : materials) {
        result.materials.push_back({material.name, {material.diffuse[0], material.diffuse[1], material.diffuse[2]}, {}, !material.diffuse_texopt.clamp});
        if (!material.diffuse_texname.empty()) result.materials.back().diffuse_image = image_beside(file, material.diffuse_texname);
        const bool emits = material.emission[0] > 0 || material.emission[1] > 0 || material.emission[2] > 0;
        const bool has_other_images = !material.alpha_texname.empty() || !material.bump_texname.empty() || !material.normal_texname.empty();
        if (emits || material.dissolve < 1.0f || material.illum >= 3 || has_other_images || places_image(material.diffuse_texopt))
            result.warnings.emplace_back("material '" + material.name + "': only its diffuse colour or image is used, where its texture coordinates place it",
                                         WarningKind::approximated);
    }
}

} // namespace

void append_materials(const std::filesystem::path& obj_file, std::string_view names, ObjFile& result)
{
    // One name, perhaps with blanks in it; else several.
    std::vector<std::filesystem::path> files = {obj_file.parent_path() / names};
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(files[0], ignored)) {
        files.clear();
        for (std::string_view name : tokens(names)) {
            if (name.starts_with('#')) break; // a comment
            files.push_back(obj_file.parent_path() / name);
        }
    }
    for (const auto& file : files) {
        try {
            append_library(file, result);
        } catch (const SceneError& error) {
            result.warnings.emplace_back(std::string("material library: ") + error.what(), WarningKind::approximated);
        }
    }
}

} // namespace sundog
