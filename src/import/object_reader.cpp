#include "import/object_reader.h"

#include "import/number_text.h"
#include "import/text_file.h"
#include "import/values.h"
#include "scene/materials.h"

#include <algorithm>
#include <climits>

namespace sundog
{

namespace
{

bool is_value_tag(std::string_view tag)
{
    constexpr std::string_view tags[] = {"boolean", "integer", "float", "string", "point", "vector", "transform", "animation"};
    return std::find(std::begin(tags), std::end(tags), tag) != std::end(tags) || is_color_tag(tag);
}

void check_value_element(const XmlElement& value)
{
    if (value.tag == "point" || value.tag == "vector")
        check_attributes(value, {"name"}, {"x", "y", "z", "value"});
    else if (value.tag == "transform" || value.tag == "animation")
        check_attributes(value, {"name"}, {});
    else if (value.tag == "boolean" || value.tag == "integer" || value.tag == "float" || value.tag == "string")
        check_attributes(value, {"name", "value"}, {});
    else if (!value.attribute("name"))
        throw SceneError(value.where, "<" + value.tag + "> needs the attribute name");
    const bool may_nest = value.tag == "transform" || value.tag == "animation" || (value.tag == "spectrum" && value.attribute("type"));
    if (!may_nest && !value.children.empty()) throw SceneError(value.where, "<" + value.tag + "> cannot have elements inside");
}

} // namespace

ObjectReader::ObjectReader(const XmlElement& element, const SceneIndex& index) : element_(element), index_(index)
{
    std::set<std::string> names;
    for (const auto& child : element.children) {
        if (child.attribute("name")) by_name_.emplace(child.parameter_name(), &child);
        if (child.tag == "alias") {
            used_.insert(&child);
            continue;
        }
        if (is_object_tag(child.tag) || child.tag == "ref") continue;
        if (!is_value_tag(child.tag)) throw SceneError(child.where, "unexpected element <" + child.tag + ">");
        check_value_element(child);
        if (!names.insert(child.parameter_name()).second)
            throw SceneError(child.where, "parameter '" + child.parameter_name() + "' of " + describe() + " is given twice");
    }
}

std::string ObjectReader::type() const
{
    const std::string* type = element_.attribute("type");
    if (!type || type->empty()) throw SceneError(where(), "<" + element_.tag + "> needs the attribute type");
    return *type;
}

std::string ObjectReader::describe() const
{
    const std::string* type = element_.attribute("type");
    return type ? element_.tag + " '" + *type + "'" : element_.tag;
}

const XmlElement* ObjectReader::find(std::string_view name) const
{
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
}

const XmlElement* ObjectReader::take(std::string_view name, std::initializer_list<std::string_view> tags)
{
    const XmlElement* value = find(name);
    if (!value) return nullptr;
    if (std::find(tags.begin(), tags.end(), value->tag) == tags.end()) {
        std::string wanted;
        for (std::string_view tag : tags) wanted += (wanted.empty() ? "<" : " or <") + std::string(tag) + ">";
        throw SceneError(value->where, "parameter '" + std::string(name) + "' of " + describe() + " must be a " + wanted + ", not a <" +
                                           value->tag + ">");
    }
    used_.insert(value);
    return value;
}

SourceLocation ObjectReader::where_of(std::string_view name) const
{
    const XmlElement* value = find(name);
    return value ? value->where : where();
}

double ObjectReader::number(std::string_view name, double fallback)
{
    const XmlElement* value = take(name, {"float", "integer"});
    if (!value) return fallback;
    const double v = number_attribute(*value, "value");
    if (!std::isfinite(static_cast<float>(v)))
        throw SceneError(value->where, "'" + std::string(name) + "' is too large for a 32-bit number");
    return v;
}

double ObjectReader::positive(std::string_view name, double fallback)
{
    const double value = number(name, fallback);
    if (!(static_cast<float>(value) > 0.0f))
        throw SceneError(where_of(name),
                         "'" + std::string(name) + "' of " + describe() + " must be > 0, got " + *find(name)->attribute("value"));
    return value;
}

double ObjectReader::number_between(std::string_view name, double fallback, double least, double most)
{
    const double value = number(name, fallback);
    if (!(value >= least && value <= most))
        throw SceneError(where_of(name), "'" + std::string(name) + "' of " + describe() + " must be between " + number_text(least) + " and " +
                                             number_text(most) + ", got " + number_text(value));
    return value;
}

int ObjectReader::integer(std::string_view name, int fallback)
{
    const XmlElement* value = take(name, {"integer"});
    if (!value) return fallback;
    const std::string& text = *value->attribute("value");
    const auto parsed = parse_integer(text);
    if (!parsed) throw SceneError(value->where, "value in <integer> must be a whole number, got '" + text + "'");
    if (*parsed < INT_MIN || *parsed > INT_MAX) throw SceneError(value->where, "'" + std::string(name) + "' is out of range: " + text);
    return static_cast<int>(*parsed);
}

bool ObjectReader::boolean(std::string_view name, bool fallback)
{
    const XmlElement* value = take(name, {"boolean"});
    if (!value) return fallback;
    std::string text = *value->attribute("value");
    std::transform(text.begin(), text.end(), text.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
    if (text == "true") return true;
    if (text == "false") return false;
    throw SceneError(value->where, "value in <boolean> must be true or false, got '" + text + "'");
}

std::string ObjectReader::text(std::string_view name, const std::string& fallback)
{
    const XmlElement* value = take(name, {"string"});
    if (value && !value->attribute("value")->empty()) return *value->attribute("value");
    if (!value && !fallback.empty()) return fallback;
    throw SceneError(value ? value->where : where(), describe() + " needs a <string name=\"" + std::string(name) + "\" value=\"...\"/>");
}

std::optional<Vec3> ObjectReader::vector(std::string_view name, const Double3& origin)
{
    const XmlElement* value = take(name, {"point", "vector"});
    if (!value) return {};
    const Vec3 v = to_vec3(difference(xyz_attributes(*value, 0.0), origin));
    if (!is_finite(v)) throw SceneError(value->where, "'" + std::string(name) + "' is too large for 32-bit numbers");
    return v;
}

void ObjectReader::place(const Transform& to_world, const Double3& counted_from)
{
    placed_ = to_world;
    counted_from_ = counted_from;
}

Vec3 ObjectReader::point(std::string_view name, const Double3& fallback)
{
    return vector(name, counted_from_).value_or(to_vec3(difference(fallback, counted_from_)));
}

Transform ObjectReader::counted_to_world()
{
    Transform to_world = transform("to_world");
    if (counted_from_ != Double3{0, 0, 0}) to_world = to_world * Transform::translate(counted_from_);
    return to_world;
}

Transform ObjectReader::transform(std::string_view name)
{
    if (placed_ && name == "to_world") return *placed_;
    if (const XmlElement* value = find(name); value && value->tag == "animation") {
        throw SceneError(value->where, describe() + " cannot move, only shapes, instances and sensors can: give '" + std::string(name) +
                                           "' by a <transform>");
    }
    const XmlElement* value = take(name, {"transform"});
    return value ? read_transform(*value) : Transform();
}

AnimatedTransform ObjectReader::animation(std::string_view name)
{
    const XmlElement* value = take(name, {"transform", "animation"});
    if (!value) return {};
    return value->tag == "animation" ? read_animation(*value) : read_transform(*value);
}

Vec3 ObjectReader::color(std::string_view name, Vec3 fallback, ColorRole role)
{
    const XmlElement* value = find(name);
    if (!value) return fallback;
    if (value->tag == "texture" || value->tag == "ref")
        throw SceneError(value->where, "'" + std::string(name) + "' of " + describe() + " cannot be a texture: give it an <rgb> value");
    value = take(name, {"rgb", "srgb", "spectrum", "blackbody", "float", "integer"});
    return read_color(*value, index_, role);
}

float ObjectReader::ior(std::string_view name, const char* fallback)
{
    if (const XmlElement* value = find(name); value && value->tag != "string") return static_cast<float>(positive(name, 1.0));
    const std::string material = text(name, fallback);
    const auto ior = find_ior(material);
    if (!ior)
        throw SceneError(where_of(name), "unknown material '" + material + "' for '" + std::string(name) + "'; known are " + ior_names());
    return *ior;
}

std::optional<NestedObject> ObjectReader::object(std::string_view name, std::string_view tag)
{
    const XmlElement* value = find(name);
    if (!value || (value->tag != tag && value->tag != "ref")) return {};
    const XmlElement& object = value->tag == "ref" ? index_.resolve(*value) : *value;
    if (object.tag != tag)
        throw SceneError(value->where, "'" + std::string(name) + "' of " + describe() + " must be a <" + std::string(tag) + ">, not a <" + object.tag + ">");
    used_.insert(value);
    return NestedObject{&object, value->where};
}

std::vector<NestedObject> ObjectReader::nested(std::string_view tag)
{
    std::vector<NestedObject> list;
    for (const auto& child : element_.children) {
        const bool is_reference = child.tag == "ref";
        if (!is_reference && child.tag != tag) continue;
        const XmlElement& object = is_reference ? index_.resolve(child) : child;
        if (object.tag != tag) continue;
        used_.insert(&child);
        list.push_back({&object, child.where});
    }
    return list;
}

std::optional<NestedObject> ObjectReader::single(std::string_view tag)
{
    const auto list = nested(tag);
    if (list.size() > 1) throw SceneError(list[1].where, describe() + " can have only one <" + std::string(tag) + ">");
    if (list.empty()) return {};
    return list.front();
}

void ObjectReader::ignore(std::string_view name, const std::string& reason)
{
    const XmlElement* value = find(name);
    if (!value || !used_.insert(value).second) return;
    index_.warn(value->where, "parameter '" + std::string(name) + "' of " + describe() + " is ignored: " + reason, WarningKind::ignored);
}

void ObjectReader::refuse(std::string_view name, const std::string& reason)
{
    if (const XmlElement* value = find(name))
        throw SceneError(value->where, "parameter '" + std::string(name) + "' of " + describe() + " is not supported: " + reason);
}

void ObjectReader::finish()
{
    for (const auto& child : element_.children) {
        if (used_.contains(&child)) continue;
        if (is_value_tag(child.tag)) {
            index_.warn(child.where, "parameter '" + child.parameter_name() + "' of " + describe() + " is not known and was ignored",
                        WarningKind::ignored);
            continue;
        }
        const XmlElement& object = child.tag == "ref" ? index_.resolve(child) : child;
        const std::string* type = object.attribute("type");
        index_.missing(child.where, object.tag + (type ? " plugin '" + *type + "'" : ""), " in " + describe(), "it is left out");
    }
}

void ObjectReader::missing(const std::string& details, const std::string& stand_in)
{
    index_.missing(where(), element_.tag + " plugin '" + type() + "'", details, stand_in);
    for (const auto& child : element_.children) used_.insert(&child);
}

void ObjectReader::unsupported(const std::string& supported) const
{
    throw SceneError(where(), element_.tag + " plugin '" + type() + "' is not supported; supported are " + supported);
}

} // namespace sundog
