#include "import/object_writer.h"

#include "import/number_text.h"

namespace sundog
{

namespace
{

void set(pugi::xml_node node, const char* attribute, const std::string& value)
{
    if (value.find('$') != std::string::npos)
        throw SceneError({}, "'" + value + "' cannot be written to a scene file, where a $ starts the name of a parameter: rename it");
    node.append_attribute(attribute).set_value(value.c_str());
}

void append_matrix(pugi::xml_node node, const Transform& t)
{
    std::string text;
    for (const auto& row : t.m)
        for (double v : row) text += (text.empty() ? "" : " ") + number_text(v);
    set(node.append_child("matrix"), "value", text);
}

} // namespace

ObjectWriter ObjectWriter::object(const char* tag, const std::string& type, const std::string& name, const std::string& id)
{
    pugi::xml_node child = node_.append_child(tag);
    set(child, "type", type);
    if (!name.empty()) set(child, "name", name);
    if (!id.empty()) set(child, "id", id);
    return ObjectWriter(child);
}

void ObjectWriter::reference(const std::string& id, const std::string& name)
{
    pugi::xml_node child = node_.append_child("ref");
    if (!name.empty()) set(child, "name", name);
    set(child, "id", id);
}

void ObjectWriter::value(const char* tag, const std::string& name, const std::string& text)
{
    pugi::xml_node child = node_.append_child(tag);
    set(child, "name", name);
    set(child, "value", text);
}

void ObjectWriter::number(const char* name, double v)
{
    value("float", name, number_text(v));
}

void ObjectWriter::number(const char* name, float v)
{
    value("float", name, number_text(v));
}

void ObjectWriter::integer(const char* name, long long v)
{
    value("integer", name, std::to_string(v));
}

void ObjectWriter::boolean(const char* name, bool v)
{
    value("boolean", name, v ? "true" : "false");
}

void ObjectWriter::text(const char* name, const std::string& v)
{
    value("string", name, v);
}

void ObjectWriter::color(const char* name, Vec3 v)
{
    value("rgb", name, number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z));
}

void ObjectWriter::vector(const char* tag, const char* name, Vec3 v)
{
    pugi::xml_node child = node_.append_child(tag);
    set(child, "name", name);
    set(child, "x", number_text(v.x));
    set(child, "y", number_text(v.y));
    set(child, "z", number_text(v.z));
}

void ObjectWriter::transform(const char* name, const Transform& t)
{
    pugi::xml_node child = node_.append_child("transform");
    set(child, "name", name);
    append_matrix(child, t);
}

void ObjectWriter::transform(const char* name, const AnimatedTransform& t)
{
    if (t.is_constant()) return transform(name, t.at(0.0));
    pugi::xml_node animation = node_.append_child("animation");
    set(animation, "name", name);
    for (const TransformKey& key : t.keys()) {
        pugi::xml_node child = animation.append_child("transform");
        set(child, "time", number_text(key.time));
        append_matrix(child, key.transform);
    }
}

} // namespace sundog
