#include "import/values.h"

#include "import/text_file.h"

#include <algorithm>

namespace sundog
{

namespace
{

const std::string& required_attribute(const XmlElement& element, std::string_view name)
{
    const std::string* value = element.attribute(name);
    if (!value) throw SceneError(element.where, "<" + element.tag + "> needs the attribute " + std::string(name));
    return *value;
}

Double3 triple_attribute(const XmlElement& element, std::string_view attribute)
{
    const std::vector<double> list = numbers_attribute(element, attribute);
    if (list.size() != 3)
        throw SceneError(element.where, std::string(attribute) + " in <" + element.tag + "> must be three numbers, got '" +
                                            *element.attribute(attribute) + "'");
    return {list[0], list[1], list[2]};
}

Transform read_look_at(const XmlElement& element)
{
    check_attributes(element, {"origin", "target"}, {"up"});
    std::optional<Double3> up;
    if (element.attribute("up")) {
        up = triple_attribute(element, "up");
        if ((*up)[0] == 0 && (*up)[1] == 0 && (*up)[2] == 0) up.reset();
    }
    const auto view = Transform::look_at(triple_attribute(element, "origin"), triple_attribute(element, "target"), up);
    if (!view) throw SceneError(element.where, "lookat needs a target away from the origin and an up vector that is not along the view");
    return *view;
}

Transform read_matrix(const XmlElement& element)
{
    check_attributes(element, {"value"}, {});
    const std::vector<double> list = numbers_attribute(element, "value");
    if (list.size() != 16 && list.size() != 9)
        throw SceneError(element.where, "<matrix> must have 16 or 9 numbers, got " + std::to_string(list.size()));
    const std::size_t n = list.size() == 16 ? 4 : 3;
    Transform t;
    for (std::size_t i = 0; i < n; i++)
        for (std::size_t j = 0; j < n; j++) t.m[i][j] = list[n * i + j];
    if (!t.is_affine()) throw SceneError(element.where, "the last row of <matrix> must be 0 0 0 1: perspective is not supported");
    return t;
}

Transform read_operation(const XmlElement& element)
{
    if (!element.children.empty()) throw SceneError(element.where, "<" + element.tag + "> cannot have elements inside");
    if (element.tag == "translate") {
        check_attributes(element, {}, {"x", "y", "z", "value"});
        return Transform::translate(xyz_attributes(element, 0.0));
    }
    if (element.tag == "scale") {
        check_attributes(element, {}, {"x", "y", "z", "value"});
        return Transform::scale(xyz_attributes(element, 1.0));
    }
    if (element.tag == "rotate") {
        check_attributes(element, {"angle"}, {"x", "y", "z", "value"});
        const Double3 axis = xyz_attributes(element, 0.0);
        if (axis[0] == 0 && axis[1] == 0 && axis[2] == 0) throw SceneError(element.where, "<rotate> needs an axis, as in y=\"1\"");
        return Transform::rotate(axis, number_attribute(element, "angle"));
    }
    if (element.tag == "lookat" || element.tag == "lookAt" || element.tag == "look_at") return read_look_at(element);
    if (element.tag == "matrix") return read_matrix(element);
    throw SceneError(element.where,
                     "unexpected <" + element.tag + "> in a transform; there are translate, rotate, scale, lookat and matrix");
}

} // namespace

void check_attributes(const XmlElement& element, std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional)
{
    const auto in = [](const auto& list, std::string_view name) { return std::find(list.begin(), list.end(), name) != list.end(); };
    for (const auto& [name, value] : element.attributes)
        if (!in(required, name) && !in(optional, name))
            throw SceneError(element.where, "unexpected attribute '" + name + "' in <" + element.tag + ">");
    for (std::string_view name : required) required_attribute(element, name);
}

double number_attribute(const XmlElement& element, std::string_view attribute)
{
    const std::string& text = required_attribute(element, attribute);
    const auto value = parse_number(text);
    if (!value)
        throw SceneError(element.where, std::string(attribute) + " in <" + element.tag + "> must be a finite number, got '" + text + "'");
    return *value;
}

std::vector<double> numbers_attribute(const XmlElement& element, std::string_view attribute)
{
    const std::string& text = required_attribute(element, attribute);
    std::vector<double> list;
    for (std::string_view token : tokens(text)) {
        const auto value = parse_number(token);
        if (!value)
            throw SceneError(element.where,
                             std::string(attribute) + " in <" + element.tag + "> must be finite numbers, got '" + std::string(token) + "'");
        list.push_back(*value);
    }
    return list;
}

Double3 xyz_attributes(const XmlElement& element, double fallback)
{
    const bool any = element.attribute("x") || element.attribute("y") || element.attribute("z");
    if (element.attribute("value")) {
        if (any) throw SceneError(element.where, "<" + element.tag + "> has both value and x, y or z: keep one");
        const std::vector<double> list = numbers_attribute(element, "value");
        if (list.size() == 1) return {list[0], list[0], list[0]};
        if (list.size() == 3) return {list[0], list[1], list[2]};
        throw SceneError(element.where,
                         "value in <" + element.tag + "> must be one or three numbers, got '" + *element.attribute("value") + "'");
    }
    if (!any) throw SceneError(element.where, "<" + element.tag + "> needs x, y, z or value");
    Double3 v;
    const std::array<const char*, 3> names = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; i++) v[i] = element.attribute(names[i]) ? number_attribute(element, names[i]) : fallback;
    return v;
}

Transform read_transform(const XmlElement& element)
{
    Transform all;
    for (const auto& operation : element.children) {
        all = read_operation(operation) * all;
        if (all.is_singular()) throw SceneError(operation.where, "the transform flattens space: a scale is 0 or a matrix is singular");
        if (!all.is_finite()) throw SceneError(operation.where, "the transform overflows");
    }
    return all;
}

AnimatedTransform read_animation(const XmlElement& element)
{
    std::vector<TransformKey> keys;
    for (const auto& child : element.children) {
        if (child.tag != "transform")
            throw SceneError(child.where, "unexpected <" + child.tag + "> in an animation: it has a <transform time=\"...\"> for each key");
        check_attributes(child, {"time"}, {});
        const TransformKey key{number_attribute(child, "time"), read_transform(child)};
        if (!keys.empty() && !(keys.back().time < key.time))
            throw SceneError(child.where,
                             "time " + *child.attribute("time") +
                                 " does not come after that of the key before it: put the transforms in the order of their times");
        if (!keys.empty() && (keys.back().transform.determinant() < 0.0) != (key.transform.determinant() < 0.0))
            throw SceneError(child.where,
                             "one of two keys is a reflection, between which the shape would be flat: mirror all keys (a negative "
                             "scale) or none");
        keys.push_back(key);
    }
    if (keys.empty()) throw SceneError(element.where, "the animation is empty: add a <transform time=\"...\"> for each key");
    return AnimatedTransform(keys);
}

Vec3 to_vec3(const Double3& v)
{
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

} // namespace sundog
