// Values in the attributes of an element.
#pragma once

#include "import/xml_document.h"
#include "math/animated_transform.h"

#include <initializer_list>

namespace sundog
{

// Throws SceneError when the element lacks a required attribute or has one that is in neither list.
void check_attributes(const XmlElement& element, std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional);

// Each throws SceneError, quoting the text, when the attribute is missing or not such a value.
double number_attribute(const XmlElement& element, std::string_view attribute);
std::vector<double> numbers_attribute(const XmlElement& element, std::string_view attribute);

// x, y, z, of which missing ones take the fallback; or value="v" or value="x, y, z".
Double3 xyz_attributes(const XmlElement& element, double fallback);

// The product of a <transform>'s operations, the first applied first.
// Throws SceneError for malformed, singular, infinite and perspective ones.
Transform read_transform(const XmlElement& element);

// An <animation>: a <transform time="..."> a key. Throws SceneError for none, for times that do not increase, for
// transforms that are broken, and for a reflection beside one that is none, between which space would be flat.
AnimatedTransform read_animation(const XmlElement& element);

Vec3 to_vec3(const Double3& v);

} // namespace sundog
