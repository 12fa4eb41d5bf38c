#include "import/scene_writer.h"

#include "import/emitter_writer.h"
#include "import/number_text.h"
#include "import/sensor_writer.h"
#include "import/shape_writer.h"
#include "import/text_file.h"

#include <sstream>

namespace sundog
{

namespace
{

// The importer keeps values as text, whatever their tag; Mitsuba does not.
const char* tag_of(const std::string& value)
{
    const auto integer = parse_integer(value);
    if (integer && *integer >= std::numeric_limits<int>::min() && *integer <= std::numeric_limits<int>::max()) return "integer";
    const auto number = parse_number(value);
    if (number && std::isfinite(static_cast<float>(*number))) return "float";
    return value == "true" || value == "false" ? "boolean" : "string";
}

void write_integrator(ObjectWriter root, const IntegratorRequest& request)
{
    if (request.method.empty()) return;
    ObjectWriter object = root.object("integrator", request.method);
    for (const auto& [name, parameter] : request.parameters) object.value(tag_of(parameter.value), name, parameter.value);
    if (request.hide_emitters) object.boolean("hide_emitters", true);
}

} // namespace

std::string write_scene(const Scene& scene, const std::filesystem::path& files)
{
    // Names every member, so that one that is added to Scene does not compile until it is written here.
    const auto& [file, origin, all_textures, all_bsdfs, shapes, groups, instances, emitters, sensor, film, integrator] = scene;
    pugi::xml_document document;
    pugi::xml_node node = document.append_child("scene");
    node.append_attribute("version").set_value("3.0.0");
    if (origin != Double3{0, 0, 0}) {
        const std::string place = number_text(origin[0]) + ", " + number_text(origin[1]) + ", " + number_text(origin[2]);
        node.append_child(pugi::node_comment).set_value((" All places are relative to (" + place + ") of the original. ").c_str());
    }
    ObjectWriter root(node);
    WrittenFiles written(files);
    WrittenIds ids;

    write_integrator(root, integrator);
    write_sensor(root, scene);
    TextureWriter textures(scene, ids, written);
    textures.write_all(root);
    const BsdfWriter bsdfs(scene, ids, textures);
    bsdfs.write_all(root);
    write_shapes(root, scene, ids, textures, bsdfs, written);
    write_emitters(root, scene, textures, written);
    textures.check_all_used();

    std::ostringstream text;
    document.save(text, "    ");
    return std::move(text).str();
}

} // namespace sundog
