#include "import/integrator_import.h"

#include "import/number_text.h"

#include <algorithm>
#include <cmath>

namespace sundog
{

namespace
{

constexpr int max_nesting = 16;

// Integrators of Mitsuba that are a method here, for scenes without media.
struct SameMethod {
    const char* type;
    const char* method;
    const char* because;
};
constexpr SameMethod same_methods[] = {
    {"direct", "path", "by path with max_depth 2, which is the light that comes straight from its source"},
    {"volpath", "path", "by path: there are no media here"},
    {"volpath_simple", "path", "by path: there are no media here"},
    {"volpathmis", "path", "by path: there are no media here"},
};

// A parameter of one of Mitsuba's integrators, or of each (integrator nullptr), under a name that a method here has.
struct Renamed {
    const char* integrator;
    const char* from;
    const char* to;
};
constexpr Renamed renamed[] = {
    {nullptr, "photon_count", "photons"},          {nullptr, "initial_radius", "radius"}, {nullptr, "max_passes", "iterations"},
    {"photonmapper", "global_photons", "photons"}, {"pssmlt", "p_large", "large_step"},   {"pssmlt", "luminance_samples", "seeds"},
};

struct Ignored {
    const char* integrator;
    const char* name;
    const char* reason;
};
constexpr const char* is_scheduling = "it says how work is split, not what is rendered";
constexpr const char* is_strategy = "it says how light is found, not what is rendered";
constexpr const char* one_sample = "an iteration takes one sample of each kind; give more iterations for less noise";
constexpr Ignored ignored[] = {
    {nullptr, "block_size", is_scheduling},
    {nullptr, "samples_per_pass", is_scheduling},
    {nullptr, "granularity", is_scheduling},
    {nullptr, "auto_cancel_gathering", is_scheduling},
    {nullptr, "timeout", "the time of a render is given on the command line (--time)"},
    {"direct", "max_depth", "direct light has two edges"},
    {"direct", "shading_samples", one_sample},
    {"direct", "emitter_samples", one_sample},
    {"direct", "bsdf_samples", one_sample},
    {"volpathmis", "use_spectral_mis", "there are no media here"},
    {"photonmapper", "direct_samples", one_sample},
    {"photonmapper", "glossy_samples", one_sample},
    {"photonmapper", "volume_photons", "there are no media here"},
    {"photonmapper", "volume_lookup_radius", "there are no media here"},
    {"photonmapper", "gather_locally", is_scheduling},
    {"photonmapper", "cancel_gathering", is_scheduling},
    {"bdpt", "light_image", is_strategy},
    {"bdpt", "sample_direct", is_strategy},
    {"pssmlt", "two_stage", is_strategy},
    {"pssmlt", "direct_samples", "direct light is rendered with all other light"},
    {"pssmlt", "light_image", is_strategy},
    {"pssmlt", "sample_direct", is_strategy},
    {"ptracer", "brute_force", "vertices of light paths are always connected to the camera"},
};

class IntegratorImport
{
public:
    IntegratorImport(const XmlElement& element, const SceneIndex& index, float scene_radius, IntegratorRequest& request)
        : element_(element), reader_(element, index), index_(index), scene_radius_(scene_radius), request_(request)
    {
    }

    void run()
    {
        request_.where = element_.where;
        request_.method = type_ = reader_.type();
        for (const auto& child : element_.children) import_parameter(child, child.parameter_name());
        choose_method();
        reader_.finish();
    }

private:
    void import_parameter(const XmlElement& child, const std::string& name)
    {
        if (name == "hide_emitters")
            request_.hide_emitters = reader_.boolean(name, false);
        else if (name == "strict_normals")
            import_strict_normals();
        else if (const Ignored* entry = find(ignored, name, &Ignored::name))
            reader_.ignore(name, entry->reason);
        else if (!import_of_photonmapper(name) && !import_of_pssmlt(name))
            keep(child, name);
    }

    // What light may do at an interpolated normal is the same for all scenes here.
    void import_strict_normals()
    {
        if (!reader_.boolean("strict_normals", true))
            index_.warn(reader_.where_of("strict_normals"),
                        "strict_normals is taken as true: interpolated normals let no light through a face", WarningKind::approximated);
    }

    // Mitsuba 0.6's lookups: the nearest photons within a radius, which is given as a fraction of the scene's.
    bool import_of_photonmapper(const std::string& name)
    {
        if (type_ != "photonmapper") return false;
        if (name == "global_lookup_radius" || name == "caustic_lookup_radius") {
            const auto radius = static_cast<float>(reader_.positive(name, 1.0) * static_cast<double>(scene_radius_));
            if (std::isfinite(radius)) // not of a scene without shapes
                set(name == "global_lookup_radius" ? "radius" : "caustic_radius", number_text(radius), name);
            return true;
        }
        if (name == "lookup_size") {
            constexpr int least = 2, most = 512; // of the method
            const int size = reader_.integer(name, most);
            if (size < least || size > most)
                index_.warn(reader_.where_of(name), "lookup_size was limited to between 2 and 512 photons", WarningKind::approximated);
            set("lookup", "nearest", name);
            set("nearest", std::to_string(std::clamp(size, least, most)), name);
            return true;
        }
        if (name == "global_photons" || name == "caustic_photons") {
            const int photons = reader_.integer(name, 0);
            index_.warn(reader_.where_of(name), name + " counts light paths here, not photons that are stored", WarningKind::approximated);
            if (photons > 0) set(name == "global_photons" ? "photons" : "caustic_photons", std::to_string(photons), name);
            return true;
        }
        return false;
    }

    bool import_of_pssmlt(const std::string& name)
    {
        if (type_ != "pssmlt" || name != "bidirectional") return false;
        set("paths", reader_.boolean(name, true) ? "bdpt" : "path", name);
        return true;
    }

    void keep(const XmlElement& child, const std::string& name)
    {
        if (child.tag == "integer") reader_.integer(name, 0);
        if (child.tag == "float") reader_.number(name, 0.0);
        if (child.tag == "boolean") reader_.boolean(name, false);
        if (child.tag == "string") reader_.text(name, "");
        const bool is_text = child.tag == "integer" || child.tag == "float" || child.tag == "boolean" || child.tag == "string";
        if (!is_text) return;
        const std::string& value = *child.attribute("value");
        const Renamed* entry = find(renamed, name, &Renamed::from);
        // -1: without an end, in Mitsuba.
        if (name == "max_passes" && value.starts_with("-")) return;
        set(entry ? entry->to : name, value, name);
    }

    void set(const std::string& name, const std::string& value, const std::string& given_as)
    {
        request_.parameters[name] = {value, reader_.where_of(given_as)};
    }

    void choose_method()
    {
        const auto* const same =
            std::find_if(std::begin(same_methods), std::end(same_methods), [&](const SameMethod& s) { return type_ == s.type; });
        if (same == std::end(same_methods)) return;
        index_.warn(element_.where, "integrator '" + type_ + "' is rendered " + same->because);
        request_.method = same->method;
        if (type_ == "direct") request_.parameters["max_depth"] = {"2", element_.where};
    }

    // The entry for a parameter of this integrator; null without one.
    template <class Entry, std::size_t n> const Entry* find(const Entry (&table)[n], const std::string& name, const char* Entry::*key) const
    {
        const auto* const found = std::find_if(std::begin(table), std::end(table), [&](const Entry& entry) {
            return name == entry.*key && (!entry.integrator || type_ == entry.integrator);
        });
        return found == std::end(table) ? nullptr : found;
    }

    const XmlElement& element_;
    ObjectReader reader_;
    const SceneIndex& index_;
    float scene_radius_;
    IntegratorRequest& request_;
    std::string type_;
};

// The first integrator inside; nothing without one.
const XmlElement* inner_integrator(const XmlElement& element, const SceneIndex& index)
{
    for (const auto& child : element.children) {
        if (child.tag == "integrator") return &child;
        if (child.tag != "ref") continue;
        if (const XmlElement& object = index.resolve(child); object.tag == "integrator") return &object;
    }
    return nullptr;
}

} // namespace

void import_integrator(const XmlElement& element, const SceneIndex& index, float scene_radius, IntegratorRequest& request)
{
    const XmlElement* chosen = &element;
    int depth = 0;
    while (const XmlElement* inner = inner_integrator(*chosen, index)) {
        index.warn(chosen->where, ObjectReader(*chosen, index).describe() + " is ignored: the one inside it is rendered",
                   WarningKind::ignored);
        if (++depth > max_nesting) throw SceneError(chosen->where, "integrators nest deeper than " + std::to_string(max_nesting));
        chosen = inner;
    }
    IntegratorImport(*chosen, index, scene_radius, request).run();
}

std::optional<NestedObject> chosen_integrator(ObjectReader& root)
{
    std::vector<NestedObject> list = root.nested("integrator");
    if (list.size() > 1) std::erase_if(list, [&](const NestedObject& one) { return root.index().is_referenced(*one.object); });
    if (list.size() > 1) throw SceneError(list[1].where, "a scene can have only one <integrator>");
    if (list.empty()) return {};
    return list.front();
}

} // namespace sundog
