#include "import/instance_import.h"

#include "import/animation_import.h"
#include "import/shape_import.h"

namespace sundog
{

namespace
{

bool is_type(const XmlElement& element, const char* name)
{
    const std::string* type = element.attribute("type");
    return type && *type == name;
}

std::string id_of(const XmlElement& element)
{
    const std::string* id = element.attribute("id");
    return id ? *id : "";
}

} // namespace

bool InstanceImporter::import(const XmlElement& element)
{
    if (is_type(element, "shapegroup")) {
        declared_.push_back(&element);
        return true;
    }
    if (!is_type(element, "instance")) return false;
    import_instance(element);
    return true;
}

void InstanceImporter::finish() const
{
    for (const XmlElement* group : declared_)
        if (!imported_.contains(group))
            index_.warn(group->where, "shapegroup '" + id_of(*group) + "' has no instance: nothing of it is seen");
}

void InstanceImporter::import_instance(const XmlElement& element)
{
    ObjectReader reader(element, index_);
    const auto group = reader.single("shape");
    if (!group)
        throw SceneError(element.where, "the instance names no shapegroup: add <ref id=\"...\"/>, the id being that of a shapegroup");
    if (!is_type(*group->object, "shapegroup"))
        throw SceneError(group->where, "an instance needs a shapegroup: put the shape into one, and refer to that");
    InstanceDescription instance;
    instance.id = id_of(element);
    instance.where = element.where;
    instance.to_world = read_to_world(reader, scene_.sensor.shutter).relative_to(index_.origins().world.place);
    reader.finish();
    const auto shown = import_group(*group->object);
    if (!shown) return;
    instance.group = *shown;
    // Of a group whose instances move there is none.
    if (const LocalOrigin origin = index_.origins().of(instance.group); origin.is_set())
        instance.to_world = instance.to_world.at(0.0) * Transform::translate(origin.place);
    scene_.instances.push_back(std::move(instance));
}

std::optional<uint> InstanceImporter::import_group(const XmlElement& element)
{
    const auto group = static_cast<uint>(scene_.groups.size());
    const auto [entry, added] = imported_.emplace(&element, group);
    if (!added) return entry->second;
    const std::size_t first_shape = scene_.shapes.size();
    scene_.groups.push_back({id_of(element), element.where});
    ObjectReader reader(element, index_);
    const auto members = reader.nested("shape");
    if (members.empty()) throw SceneError(element.where, "the shapegroup is empty: put the shapes that its instances show into it");
    for (const NestedObject& member : members) import_member(member, group);
    reader.finish();
    if (scene_.shapes.size() == first_shape) { // all of them are left out
        scene_.groups.pop_back();
        entry->second.reset();
    }
    return entry->second;
}

void InstanceImporter::import_member(const NestedObject& member, uint group)
{
    if (is_type(*member.object, "shapegroup") || is_type(*member.object, "instance"))
        throw SceneError(member.where, "a shapegroup cannot hold a shapegroup or an instance: put their shapes into it themselves");
    if (const auto emitter = ObjectReader(*member.object, index_).single("emitter"))
        throw SceneError(emitter->where, "a light cannot be inside a shapegroup: give each copy that emits a shape of its own");
    if (ObjectReader reader(*member.object, index_);
        reader.animation("to_world").moves(scene_.sensor.shutter.open, scene_.sensor.shutter.close))
        throw SceneError(reader.where_of("to_world"),
                         "a shape inside a shapegroup cannot move by itself: give the <animation> to its instances");
    import_shape(*member.object, index_, bsdfs_, textures_, scene_, group);
}

} // namespace sundog
