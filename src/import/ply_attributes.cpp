#include "import/ply_attributes.h"

#include <algorithm>

namespace sundog
{

namespace
{

constexpr std::array<std::string_view, 4> suffix_schemes = {"xyzw", "rgba", "0123", "1234"};

class AttributeFinder
{
public:
    AttributeFinder(const PlyElement& element, const std::string& prefix, const std::vector<std::size_t>& taken)
        : element_(element), prefix_(prefix), taken_(element.properties.size(), false)
    {
        for (std::size_t i : taken) taken_[i] = true;
    }

    PlyAttributes find()
    {
        find_color("r", "g", "b") || find_color("red", "green", "blue") || find_color("diffuse_red", "diffuse_green", "diffuse_blue");
        for (std::size_t i = 0; i < taken_.size(); i++)
            if (!taken_[i]) find_group(i);
        return std::move(found_);
    }

private:
    bool find_color(std::string_view red, std::string_view green, std::string_view blue)
    {
        const std::array<std::size_t, 3> properties = {element_.scalar(red), element_.scalar(green), element_.scalar(blue)};
        for (std::size_t i : properties)
            if (i == PlyElement::none) return false;
        for (std::size_t i : properties) taken_[i] = true;
        found_.list.push_back({prefix_ + "color", properties, true});
        return true;
    }

    // The consecutive properties from `first` on whose suffixes follow one scheme.
    void find_group(std::size_t first)
    {
        const std::string& name = element_.properties[first].name;
        const std::size_t stem = name.find_last_of('_');
        std::size_t end = first + 1;
        std::size_t scheme = 0;
        if (stem != std::string::npos && stem + 2 == name.size() && !element_.properties[first].count_type) {
            while (scheme < suffix_schemes.size() && suffix_schemes[scheme][0] != name.back()) scheme++;
            if (scheme < suffix_schemes.size()) {
                const std::string start = name.substr(0, stem + 1);
                const auto follows = [&](std::size_t i) {
                    return i < taken_.size() && i - first < 4 && !taken_[i] && !element_.properties[i].count_type &&
                           element_.properties[i].name == start + suffix_schemes[scheme][i - first];
                };
                while (follows(end)) end++;
                if (end - first == 1 || end - first == 3) add_group(first, end, scheme, name.substr(0, stem));
            }
        }
        for (std::size_t i = first; i < end; i++) {
            if (!taken_[i]) found_.unused.push_back(element_.properties[i].name);
            taken_[i] = true;
        }
    }

    void add_group(std::size_t first, std::size_t end, std::size_t scheme, const std::string& stem)
    {
        const bool is_color = suffix_schemes[scheme][0] == 'r';
        const std::string name = prefix_ + stem + (is_color ? "_color" : "");
        const bool known = std::any_of(found_.list.begin(), found_.list.end(), [&](const auto& other) { return other.name == name; });
        if (known) return;
        if (end - first == 1)
            found_.list.push_back({name, {first, first, first}, is_color});
        else
            found_.list.push_back({name, {first, first + 1, first + 2}, is_color});
        for (std::size_t i = first; i < end; i++) taken_[i] = true;
    }

    const PlyElement& element_;
    const std::string& prefix_;
    std::vector<bool> taken_;
    PlyAttributes found_;
};

} // namespace

PlyAttributes find_attributes(const PlyElement& element, const std::string& prefix, const std::vector<std::size_t>& taken)
{
    return AttributeFinder(element, prefix, taken).find();
}

} // namespace sundog
