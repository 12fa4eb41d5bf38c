#include "scene/color_channels.h"

#include "base/errors.h"
#include "scene/spectrum.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace sundog {

namespace {

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string layer_of(const std::string& name)
{
    return name.substr(0, name.rfind('.') + 1); // npos + 1 = 0
}

// "color.Red" is r.
std::string short_name(const std::string& name)
{
    const std::string last = lower(name.substr(name.rfind('.') + 1));
    for (const auto& [long_name, short_one] : {std::pair("red", "r"), std::pair("green", "g"), std::pair("blue", "b"), std::pair("alpha", "a")})
        if (last == long_name) return short_one;
    return last;
}

// Places of channels, by layer and short name.
using Layers = std::map<std::string, std::map<std::string, std::size_t>>;

Layers layers_of(std::span<const std::string> names)
{
    Layers layers;
    for (std::size_t i = 0; i < names.size(); i++) layers[layer_of(names[i])].emplace(short_name(names[i]), i);
    return layers;
}

std::optional<std::array<std::size_t, 3>> find_three(const std::map<std::string, std::size_t>& layer, const std::array<const char*, 3>& names)
{
    std::array<std::size_t, 3> places{};
    for (std::size_t i = 0; i < 3; i++) {
        const auto found = layer.find(names[i]);
        if (found == layer.end()) return {};
        places[i] = found->second;
    }
    return places;
}

struct Kind {
    ColorChannels::Model model;
    std::array<const char*, 3> names;
    bool in_layers; // also in a layer that has a name
};
constexpr Kind kinds[] = {
    {ColorChannels::Model::rgb, {"r", "g", "b"}, true},
    {ColorChannels::Model::luminance_chroma, {"y", "ry", "by"}, true},
    {ColorChannels::Model::xyz, {"x", "y", "z"}, false},
    {ColorChannels::Model::rgb, {"y", "y", "y"}, true},
};

[[noreturn]] void refuse(std::span<const std::string> names, const std::string& why, const std::filesystem::path& file)
{
    throw FileError(file.string() + ": " + why + ": give it R G B, Y, or X Y Z; its channels are " + list_of_channels(names));
}

// The default layer's, else the one layer's; nothing where no layer has them.
std::optional<ColorChannels> find_kind(const Layers& layers, const Kind& kind, std::span<const std::string> names, const std::filesystem::path& file)
{
    std::optional<ColorChannels> found;
    for (const auto& [layer, channels] : layers) { // the default layer is the first
        if (!layer.empty() && !kind.in_layers) break;
        const auto places = find_three(channels, kind.names);
        if (!places || (!layer.empty() && channels.contains("x"))) continue; // a normal or a place
        if (found && !layer.empty()) refuse(names, "several of its layers are colours, and none of them is the default one", file);
        found = ColorChannels{kind.model, *places, layer};
        if (layer.empty()) break;
    }
    return found;
}

std::optional<ColorChannels> find_color(std::span<const std::string> names, const std::filesystem::path& file)
{
    const Layers layers = layers_of(names);
    for (const Kind& kind : kinds)
        if (const auto found = find_kind(layers, kind, names, file)) return found;
    if (names.size() == 1) return ColorChannels{ColorChannels::Model::rgb, {0, 0, 0}, layer_of(names.front())};
    return {};
}

} // namespace

Vec3 ColorChannels::color(Vec3 values) const
{
    switch (model) {
    case Model::rgb:
        break;
    case Model::xyz:
        return linear_srgb_from_xyz(values.x, values.y, values.z);
    case Model::luminance_chroma: {
        const float red = values.x * (1.0f + values.y), blue = values.x * (1.0f + values.z);
        return {red, (values.x - 0.2126f * red - 0.0722f * blue) / 0.7152f, blue};
    }
    }
    return values;
}

ColorChannels color_channels(std::span<const std::string> names, const std::filesystem::path& file)
{
    if (const auto found = find_color(names, file)) return *found;
    refuse(names, "it has no channels that are a colour", file);
}

std::optional<std::size_t> find_channel(std::span<const std::string> names, const std::string& name)
{
    const std::string wanted = lower(name);
    for (std::size_t i = 0; i < names.size(); i++)
        if (lower(names[i]) == wanted) return i;
    const Layers layers = layers_of(names);
    const auto in_layer = [&](const std::string& layer) -> std::optional<std::size_t> {
        const auto channels = layers.find(layer);
        if (channels == layers.end()) return {};
        const auto found = channels->second.find(wanted);
        if (found == channels->second.end()) return {};
        return found->second;
    };
    if (const auto found = in_layer("")) return found;
    const bool is_color = wanted == "r" || wanted == "g" || wanted == "b";
    if (!is_color && wanted != "a") return {};
    const ColorChannels color = color_channels(names, {});
    if (const auto found = in_layer(color.layer)) return found;
    if (is_color && color.index[0] == color.index[1]) return color.index[0];
    return {};
}

std::string list_of_channels(std::span<const std::string> names)
{
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : " ") + name;
    return list;
}

} // namespace sundog
