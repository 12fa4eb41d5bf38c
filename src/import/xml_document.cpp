#include "import/xml_document.h"

#include "import/xml_file.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace sundog
{

namespace
{

// More than any scene needs, and few enough that nested includes cannot exhaust the memory.
constexpr int max_include_depth = 16;
constexpr int max_includes = 10'000;
constexpr int max_element_depth = 64;
constexpr std::size_t max_elements = 4'000'000;
// Bytes of all attributes together, parameters substituted: each <default> can hold the one before many times over.
constexpr std::size_t max_text = std::size_t{1} << 28;
constexpr std::size_t max_xml = std::size_t{1} << 30; // bytes of all files together

std::string quoted_list(const std::set<std::string>& names)
{
    std::string list;
    for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

class SceneReader
{
public:
    SceneReader(const std::map<std::string, std::string>& defines, std::vector<Warning>& warnings)
        : parameters_(defines.begin(), defines.end()), defines_(defines), warnings_(warnings)
    {
        for (const auto& [name, value] : defines) {
            if (name.empty()) throw UsageError("-D: a parameter needs a name, as in -D NAME=VALUE");
            name_lengths_.insert(name.size());
        }
    }

    XmlScene read(const std::filesystem::path& file)
    {
        scene_.file = file.string();
        const XmlFile xml(file, {file.string(), 0}, FileKind::regular_or_standard_input);
        count_file(xml, {file.string(), 0});
        const pugi::xml_node root = xml.root();
        if (std::string_view(root.name()) != "scene")
            throw SceneError(xml.where(root), "the root element must be <scene>, not <" + std::string(root.name()) + ">");
        open_files_.push_back(file);
        scene_.legacy = is_legacy(xml, root);
        scene_.root.tag = "scene";
        scene_.root.where = xml.where(root);
        read_attributes(xml, root, scene_.root);
        read_children(xml, root, scene_.root, 1);
        check_defines();
        return std::move(scene_);
    }

private:
    bool is_legacy(const XmlFile& xml, pugi::xml_node root)
    {
        const std::string version = root.attribute("version").value();
        if (version.empty()) {
            const SourceLocation where = xml.where(root);
            warnings_.push_back(where.prefix() + "<scene> has no version attribute; taken as version=\"3.0.0\"");
            return false;
        }
        const bool valid = std::isdigit(static_cast<unsigned char>(version[0])) != 0 &&
                           std::all_of(version.begin(), version.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
        if (!valid) throw SceneError(xml.where(root), "version must be of the form 3.0.0, got '" + version + "'");
        return version == "0" || version.starts_with("0.") || version == "1" || version.starts_with("1.");
    }

    void read_children(const XmlFile& xml, pugi::xml_node node, XmlElement& parent, int depth)
    {
        for (const pugi::xml_node child : node.children()) {
            if (child.type() == pugi::node_element)
                read_element(xml, child, parent, depth);
            else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
                throw SceneError(xml.where(child), "unexpected text inside <" + parent.tag + ">: values are written as attributes");
        }
    }

    void read_element(const XmlFile& xml, pugi::xml_node node, XmlElement& parent, int depth)
    {
        XmlElement element;
        element.tag = node.name();
        element.where = xml.where(node);
        if (depth > max_element_depth) throw SceneError(element.where, "elements nest deeper than " + std::to_string(max_element_depth));
        if (++element_count_ > max_elements)
            throw SceneError(element.where, "the scene has more than " + std::to_string(max_elements) + " elements with its includes");
        read_attributes(xml, node, element);
        if (element.tag == "default")
            read_default(element);
        else if (element.tag == "include")
            read_include(element, parent, depth);
        else if (element.tag == "path")
            read_path(element, depth);
        else {
            read_children(xml, node, element, depth + 1);
            parent.children.push_back(std::move(element));
        }
    }

    void read_attributes(const XmlFile& xml, pugi::xml_node node, XmlElement& element)
    {
        std::set<std::string_view> names;
        for (const pugi::xml_attribute attribute : node.attributes()) {
            if (!names.insert(attribute.name()).second)
                throw SceneError(xml.where(node),
                                 "attribute '" + std::string(attribute.name()) + "' is given twice in <" + element.tag + ">");
            element.attributes.emplace_back(attribute.name(), substitute(attribute.value(), element.where));
        }
    }

    // Replaces $name by the parameter with the longest matching name, as Mitsuba does.
    std::string substitute(const std::string& text, const SourceLocation& where)
    {
        std::string result;
        for (std::size_t i = 0; i < text.size();) {
            if (text_bytes_ + result.size() > max_text)
                throw SceneError(where,
                                 "the attributes hold more than " + std::to_string(max_text) + " bytes when parameters are substituted");
            if (text[i] != '$') {
                result += text[i++];
                continue;
            }
            const std::string_view rest = std::string_view(text).substr(i + 1);
            const auto best = find_parameter(rest);
            if (best == parameters_.end()) throw SceneError(where, "undefined parameter in '" + text + "': " + cure_for_undefined(rest));
            known_.insert(best->first);
            result += best->second;
            i += 1 + best->first.size();
        }
        text_bytes_ += result.size();
        return result;
    }

    // The parameter with the longest name that `text` begins with.
    std::map<std::string, std::string, std::less<>>::const_iterator find_parameter(std::string_view text) const
    {
        for (auto length = name_lengths_.rbegin(); length != name_lengths_.rend(); ++length) {
            if (*length > text.size()) continue;
            if (const auto found = parameters_.find(text.substr(0, *length)); found != parameters_.end()) return found;
        }
        return parameters_.end();
    }

    static std::string cure_for_undefined(std::string_view rest)
    {
        std::size_t n = 0;
        while (n < rest.size() && (std::isalnum(static_cast<unsigned char>(rest[n])) || rest[n] == '_')) n++;
        const std::string name(rest.substr(0, n));
        if (name.empty()) return "a name must follow the $";
        return "pass -D " + name + "=VALUE or give it a <default name=\"" + name + "\" value=\"...\"/> above";
    }

    void read_default(const XmlElement& element)
    {
        const std::string* name = element.attribute("name");
        const std::string* value = element.attribute("value");
        if (!name || name->empty() || !value) throw SceneError(element.where, "<default> needs the attributes name and value");
        known_.insert(*name);
        name_lengths_.insert(name->size());
        parameters_.emplace(*name, *value);
    }

    void read_path(const XmlElement& element, int depth)
    {
        const std::string* value = element.attribute("value");
        if (!value || value->empty()) throw SceneError(element.where, "<path> needs the attribute value");
        if (depth != 1) throw SceneError(element.where, "<path> must be a child of <scene>");
        std::string tried;
        for (const auto& folder : places_of(*value, std::filesystem::path(element.where.file).parent_path())) {
            std::error_code failed;
            if (std::filesystem::is_directory(folder, failed)) {
                scene_.resource_folders.insert(scene_.resource_folders.begin(), folder);
                return;
            }
            tried += (tried.empty() ? "'" : ", '") + folder.string() + "'";
        }
        warnings_.emplace_back(element.where.prefix() + "<path> is ignored: there is no folder " + tried, WarningKind::ignored);
    }

    // Where what a file in `beside` names may be: there, in the folders of <path>, and beside the scene.
    std::vector<std::filesystem::path> places_of(const std::filesystem::path& name, const std::filesystem::path& beside) const
    {
        if (name.is_absolute()) return {name};
        std::vector<std::filesystem::path> places = {beside / name};
        for (const auto& folder : scene_.resource_folders) places.push_back(folder / name);
        if (const auto place = std::filesystem::path(scene_.file).parent_path() / name; place != places.front()) places.push_back(place);
        return places;
    }

    void read_include(const XmlElement& element, XmlElement& parent, int depth)
    {
        const std::string* name = element.attribute("filename");
        if (!name || name->empty()) throw SceneError(element.where, "<include> needs the attribute filename");
        const std::filesystem::path file = find_included(*name, element.where);
        refuse_cycle(file, element.where);
        if (open_files_.size() >= max_include_depth)
            throw SceneError(element.where, "includes nest deeper than " + std::to_string(max_include_depth));
        if (++include_count_ > max_includes)
            throw SceneError(element.where, "more than " + std::to_string(max_includes) + " files are included");
        const XmlFile xml(file, element.where);
        count_file(xml, element.where);
        const pugi::xml_node root = xml.root();
        open_files_.push_back(file);
        scene_.included.push_back(file);
        if (std::string_view(root.name()) == "scene")
            read_children(xml, root, parent, depth);
        else
            read_element(xml, root, parent, depth);
        open_files_.pop_back();
    }

    std::filesystem::path find_included(const std::string& name, const SourceLocation& where) const
    {
        std::filesystem::path path(name);
        if (path.is_absolute()) return path;
        std::error_code failed;
        for (const auto& folder : scene_.resource_folders)
            if (std::filesystem::exists(folder / path, failed)) return folder / path;
        const std::filesystem::path beside_scene = std::filesystem::path(scene_.file).parent_path() / path;
        if (std::filesystem::exists(beside_scene, failed)) return beside_scene;
        return std::filesystem::path(where.file).parent_path() / path;
    }

    void count_file(const XmlFile& xml, const SourceLocation& where)
    {
        xml_bytes_ += xml.size();
        if (xml_bytes_ > max_xml)
            throw SceneError(where, "the scene and its includes have more than " + std::to_string(max_xml) + " bytes together");
    }

    void refuse_cycle(const std::filesystem::path& file, const SourceLocation& where) const
    {
        std::error_code failed;
        const auto same = [&](const std::filesystem::path& open) { return std::filesystem::equivalent(open, file, failed); };
        const auto first = std::find_if(open_files_.begin(), open_files_.end(), same);
        if (first == open_files_.end()) return;
        std::string chain;
        for (auto open = first; open != open_files_.end(); ++open) chain += open->filename().string() + " includes ";
        throw SceneError(where, "cyclic <include>: " + chain + file.filename().string());
    }

    void check_defines() const
    {
        for (const auto& [name, value] : defines_)
            if (!known_.contains(name))
                throw UsageError("-D " + name + ": " + scene_.file + " has no parameter of that name; " +
                                 (known_.empty() ? "it has none at all" : "it has " + quoted_list(known_)));
    }

    std::map<std::string, std::string, std::less<>> parameters_;
    std::set<std::size_t> name_lengths_; // of the parameters
    const std::map<std::string, std::string>& defines_;
    std::vector<Warning>& warnings_;
    std::set<std::string> known_; // parameters that some <default> or $name mentions
    std::vector<std::filesystem::path> open_files_;
    std::size_t element_count_ = 0;
    std::size_t text_bytes_ = 0; // of the attributes so far
    std::size_t xml_bytes_ = 0;
    int include_count_ = 0;
    XmlScene scene_;
};

} // namespace

const std::string* XmlElement::attribute(std::string_view name) const
{
    for (const auto& [key, value] : attributes)
        if (key == name) return &value;
    return nullptr;
}

std::string XmlElement::parameter_name() const
{
    const std::string* name = attribute("name");
    return name ? snake_case(*name) : std::string();
}

XmlScene read_scene_xml(const std::filesystem::path& file, const std::map<std::string, std::string>& defines,
                        std::vector<Warning>& warnings)
{
    return SceneReader(defines, warnings).read(file);
}

std::string snake_case(std::string_view name)
{
    std::string result;
    for (std::size_t i = 0; i < name.size(); i++) {
        const auto c = static_cast<unsigned char>(name[i]);
        if (i > 0 && std::isupper(c) && std::islower(static_cast<unsigned char>(name[i - 1]))) result += '_';
        result += static_cast<char>(std::tolower(c));
    }
    return result;
}

} // namespace sundog
