#include "import/integrator_import.h"

#include <map>

namespace sundog
{

namespace
{

// Mitsuba's parameters that say how work is split or seeded, not what is rendered.
bool is_scheduling(const std::string& name)
{
    return name == "block_size" || name == "samples_per_pass" || name == "granularity" || name == "timeout" || name == "strict_normals" ||
           name == "auto_cancel_gathering";
}

std::string translated(const std::string& name)
{
    static const std::map<std::string, std::string> names = {
        {"photon_count", "photons"}, {"initial_radius", "radius"}, {"max_passes", "iterations"}};
    const auto found = names.find(name);
    return found == names.end() ? name : found->second;
}

} // namespace

void import_integrator(const XmlElement& element, const SceneIndex& index, IntegratorRequest& request)
{
    ObjectReader reader(element, index);
    for (const auto& child : element.children) {
        if (child.tag != "integrator") continue; // in place: a <ref> could lead back here
        index.warn(element.where, "integrator '" + reader.type() + "' is ignored: the one inside it is rendered", WarningKind::ignored);
        import_integrator(child, index, request);
        return;
    }
    request.where = element.where;
    request.method = reader.type();
    for (const auto& child : element.children) {
        const std::string name = child.parameter_name();
        if (is_scheduling(name)) {
            reader.ignore(name, "it has no effect on the image here");
            continue;
        }
        if (name == "hide_emitters") {
            if (reader.boolean(name, false)) reader.refuse(name, "emitters are always visible; remove it");
            continue;
        }
        if (child.tag == "integer") reader.integer(name, 0);
        if (child.tag == "float") reader.number(name, 0.0);
        if (child.tag == "boolean") reader.boolean(name, false);
        if (child.tag == "string") reader.text(name, "");
        const bool is_text = child.tag == "integer" || child.tag == "float" || child.tag == "boolean" || child.tag == "string";
        if (is_text) request.parameters[translated(name)] = {*child.attribute("value"), child.where};
    }
    reader.finish();
}

} // namespace sundog
