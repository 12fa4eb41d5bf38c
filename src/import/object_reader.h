// Typed access to the parameters of one object of a scene file, which complains about what is wrong with one
// and, at the end, about those that nobody asked for.
#pragma once

#include "import/colors.h"
#include "import/scene_index.h"
#include "math/animated_transform.h"

#include <map>
#include <optional>
#include <set>

namespace sundog
{

// An object inside another, in place or by <ref>.
struct NestedObject {
    const XmlElement* object;
    SourceLocation where; // of the object or of its <ref>
};

class ObjectReader
{
public:
    // Throws SceneError for two parameters of one name and for values with missing or unknown attributes.
    ObjectReader(const XmlElement& element, const SceneIndex& index);

    const XmlElement& element() const { return element_; }
    const SourceLocation& where() const { return element_.where; }
    std::string type() const;     // throws SceneError without one
    std::string describe() const; // "bsdf 'diffuse'"

    // Values by snake_case name. Each throws SceneError, at the parameter's line, for a wrong type or value.
    bool has(std::string_view name) const { return find(name) != nullptr; }
    const XmlElement* find(std::string_view name) const; // nullptr without one
    SourceLocation where_of(std::string_view name) const; // the object's own without the parameter
    double number(std::string_view name, double fallback);
    double positive(std::string_view name, double fallback); // > 0
    double number_between(std::string_view name, double fallback, double least, double most);
    int integer(std::string_view name, int fallback);
    bool boolean(std::string_view name, bool fallback);
    std::string text(std::string_view name, const std::string& fallback); // throws without a value and fallback ""
    std::optional<Vec3> vector(std::string_view name, const Double3& origin = {0, 0, 0}); // <point> or <vector>, less the origin
    Transform transform(std::string_view name);                           // identity without one; throws for what moves
    AnimatedTransform animation(std::string_view name);                   // <transform> or <animation>
    // What transform("to_world") returns from now on; and the place, in the space that it maps from, that places are
    // counted from in double precision: those that point() reads, and those of files. The second maps what was counted.
    void place(const Transform& to_world, const Double3& counted_from);
    Vec3 point(std::string_view name, const Double3& fallback);
    const Double3& counted_from() const { return counted_from_; }
    Transform counted_to_world();
    Vec3 color(std::string_view name, Vec3 fallback, ColorRole role);
    // The index of refraction in a <float>, or named in a <string>.
    float ior(std::string_view name, const char* fallback);

    // A parameter that is an object of the given tag, in place or by <ref>. Nothing when it is missing or a value.
    std::optional<NestedObject> object(std::string_view name, std::string_view tag);

    // Objects of one tag.
    std::vector<NestedObject> nested(std::string_view tag);
    // At most one; throws SceneError for more.
    std::optional<NestedObject> single(std::string_view tag);

    // A parameter without effect on the image: a warning with the reason, if it is there.
    void ignore(std::string_view name, const std::string& reason);
    // A parameter that changes the image in a way that is not supported: an error, if it is there.
    void refuse(std::string_view name, const std::string& reason);
    // Warns of parameters, and throws SceneError for objects, that were not asked for.
    void finish();

    [[noreturn]] void unsupported(const std::string& supported) const; // this plugin
    // This plugin is not supported, as SceneIndex::missing says; nothing inside it is read.
    void missing(const std::string& details, const std::string& stand_in);

    const SceneIndex& index() const { return index_; }

private:
    const XmlElement* take(std::string_view name, std::initializer_list<std::string_view> tags);

    const XmlElement& element_;
    const SceneIndex& index_;
    std::map<std::string, const XmlElement*, std::less<>> by_name_; // the first of each name
    std::set<const XmlElement*> used_;
    std::optional<Transform> placed_;
    Double3 counted_from_{0, 0, 0};
};

} // namespace sundog
