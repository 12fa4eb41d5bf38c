// Objects and parameters of a Mitsuba 3 scene file, being written: the counterpart of ObjectReader.
#pragma once

#include "math/animated_transform.h"
#include "scene/scene.h"

#include <pugixml.hpp>

namespace sundog
{

// Stands for one element; cheap to copy. All numbers read back as the same bits. Every member throws SceneError for a
// text with a $, which a scene file cannot express.
class ObjectWriter
{
public:
    explicit ObjectWriter(pugi::xml_node node) : node_(node) {}

    // An object inside this one; an empty name or id is left out.
    ObjectWriter object(const char* tag, const std::string& type, const std::string& name = "", const std::string& id = "");
    void reference(const std::string& id, const std::string& name = "");

    void number(const char* name, double value);
    void number(const char* name, float value);
    void integer(const char* name, long long value);
    void boolean(const char* name, bool value);
    void text(const char* name, const std::string& value);
    void color(const char* name, Vec3 value);
    void vector(const char* tag, const char* name, Vec3 value); // <point> or <vector>
    void transform(const char* name, const Transform& value);
    void transform(const char* name, const AnimatedTransform& value); // <animation> where there are several keys
    // A parameter of any tag whose value is a text already.
    void value(const char* tag, const std::string& name, const std::string& text);

private:
    pugi::xml_node node_;
};

} // namespace sundog
