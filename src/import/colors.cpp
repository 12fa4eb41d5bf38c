#include "import/colors.h"

#include "import/text_file.h"
#include "import/values.h"
#include "math/srgb.h"
#include "scene/spectrum.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

namespace sundog
{

namespace
{

using Samples = std::vector<SpectrumSample>;

Vec3 reduce(const Samples& samples, ColorRole role)
{
    switch (role) {
    case ColorRole::reflectance:
        return reflectance_to_rgb(samples);
    case ColorRole::emission:
        return emission_to_rgb(samples);
    case ColorRole::index:
        break;
    }
    return index_to_rgb(samples);
}

Vec3 gray(double value)
{
    const auto v = static_cast<float>(value);
    return {v, v, v};
}

// "#rrggbb" as fractions of 255.
Vec3 read_hex(const XmlElement& element, const std::string& text)
{
    std::array<float, 3> channel{};
    bool valid = text.size() == 7;
    for (std::size_t i = 0; valid && i < 3; i++) {
        unsigned value = 0;
        const char* begin = text.data() + 1 + 2 * i;
        const auto [end, error] = std::from_chars(begin, begin + 2, value, 16);
        valid = error == std::errc() && end == begin + 2;
        channel[i] = static_cast<float>(value) / 255.0f;
    }
    if (!valid) throw SceneError(element.where, "a colour must be three numbers or of the form #rrggbb, got '" + text + "'");
    return {channel[0], channel[1], channel[2]};
}

Vec3 read_rgb(const XmlElement& element)
{
    check_attributes(element, {"value"}, {"name", "intent"});
    const std::string& text = *element.attribute("value");
    const auto words = tokens(text);
    if (words.size() == 1 && words[0].starts_with('#')) return read_hex(element, std::string(words[0]));
    const std::vector<double> list = numbers_attribute(element, "value");
    if (list.size() == 1) return gray(list[0]);
    if (list.size() != 3) throw SceneError(element.where, "<" + element.tag + "> must have one or three numbers, got '" + text + "'");
    return to_vec3({list[0], list[1], list[2]});
}

Vec3 read_srgb(const XmlElement& element)
{
    const Vec3 encoded = read_rgb(element);
    return {linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z)};
}

void check_samples(const Samples& samples, const SourceLocation& where)
{
    if (samples.size() < 2) throw SceneError(where, "a spectrum needs at least two wavelength:value pairs");
    for (std::size_t i = 0; i < samples.size(); i++) {
        if (i > 0 && samples[i].wavelength <= samples[i - 1].wavelength)
            throw SceneError(where, "the wavelengths of a spectrum must increase");
        if (samples[i].value < 0.0) throw SceneError(where, "a spectrum must not have negative values");
    }
}

Samples parse_pairs(const XmlElement& element, const std::vector<std::string_view>& pairs)
{
    Samples samples;
    for (std::string_view pair : pairs) {
        const std::size_t colon = pair.find(':');
        const auto wavelength = parse_number(pair.substr(0, colon));
        const auto value = colon == std::string_view::npos ? std::nullopt : parse_number(pair.substr(colon + 1));
        if (!wavelength || !value)
            throw SceneError(element.where, "a spectrum must be one number or pairs wavelength:value, got '" + std::string(pair) + "'");
        samples.push_back({*wavelength, *value});
    }
    check_samples(samples, element.where);
    return samples;
}

// Lines of a wavelength (nm) and a value; # starts a comment.
Samples read_spectrum_file(const std::filesystem::path& file, const SourceLocation& where)
{
    std::istringstream content(read_text_file(file, where));
    Samples samples;
    std::string line;
    for (int number = 1; std::getline(content, line); number++) {
        const auto words = tokens(std::string_view(line).substr(0, line.find('#')));
        if (words.empty()) continue;
        const auto wavelength = parse_number(words[0]);
        const auto value = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
        if (!wavelength || !value) throw SceneError({file.string(), number}, "a line of a spectrum must be a wavelength and a value");
        samples.push_back({*wavelength, *value});
    }
    check_samples(samples, {file.string(), 0});
    return samples;
}

double kelvins(const XmlElement& element, std::string text)
{
    if (!text.empty() && (text.back() == 'K' || text.back() == 'k')) text.pop_back();
    const auto kelvin = parse_number(text);
    if (!kelvin || !(*kelvin > 0.0) || *kelvin > 1e7)
        throw SceneError(element.where, "the temperature of a black body must be between 0 and 1e7 kelvin, got '" + text + "'");
    return *kelvin;
}

Vec3 read_blackbody(const XmlElement& element)
{
    check_attributes(element, {"temperature"}, {"name", "scale"});
    const double scale = element.attribute("scale") ? number_attribute(element, "scale") : 1.0;
    return blackbody_to_rgb(kelvins(element, *element.attribute("temperature"))) * static_cast<float>(scale);
}

// <spectrum type="..."> with parameters inside.
Vec3 read_spectrum_object(const XmlElement& element, const SceneIndex& index)
{
    const std::string& type = *element.attribute("type");
    const std::string wanted = type == "blackbody" ? "temperature" : "value";
    if (type != "blackbody" && type != "uniform")
        throw SceneError(element.where, "spectrum plugin '" + type + "' is not supported; supported are blackbody, uniform");
    const XmlElement* main = nullptr;
    double scale = 1.0;
    for (const auto& child : element.children) {
        const std::string name = child.parameter_name();
        if (child.tag != "float" && child.tag != "integer") throw SceneError(child.where, "unexpected <" + child.tag + "> in a spectrum");
        if (name == wanted)
            main = &child;
        else if (name == "scale")
            scale = number_attribute(child, "value");
        else
            index.warn(child.where, "parameter '" + name + "' of spectrum '" + type + "' is not known and was ignored", WarningKind::ignored);
    }
    if (!main) throw SceneError(element.where, "spectrum '" + type + "' needs a <float name=\"" + wanted + "\">");
    const double value = number_attribute(*main, "value");
    if (type == "uniform") return gray(value * scale);
    return blackbody_to_rgb(kelvins(*main, *main->attribute("value"))) * static_cast<float>(scale);
}

Vec3 read_spectrum(const XmlElement& element, const SceneIndex& index, ColorRole role)
{
    if (element.attribute("type")) return read_spectrum_object(element, index);
    check_attributes(element, {}, {"name", "value", "filename", "intent"});
    const std::string* value = element.attribute("value");
    const std::string* filename = element.attribute("filename");
    if (!value == !filename) throw SceneError(element.where, "<spectrum> needs either value or filename");
    if (filename) return reduce(read_spectrum_file(index.find_file(*filename, element.where), element.where), role);
    const auto words = tokens(*value);
    if (words.size() == 1 && words[0].find(':') == std::string_view::npos) {
        const double number = number_attribute(element, "value");
        // The same at all wavelengths: grey where it reflects, but equal-energy white where it shines (0.6: grey).
        if (role != ColorRole::emission || index.legacy()) return gray(number);
        return linear_srgb_from_xyz(number, number, number);
    }
    return reduce(parse_pairs(element, words), role);
}

Vec3 read_unchecked(const XmlElement& element, const SceneIndex& index, ColorRole role)
{
    if (element.tag == "rgb") return read_rgb(element);
    if (element.tag == "srgb") return read_srgb(element);
    if (element.tag == "spectrum") return read_spectrum(element, index, role);
    if (element.tag == "blackbody") return read_blackbody(element);
    check_attributes(element, {"name", "value"}, {});
    return gray(number_attribute(element, "value"));
}

} // namespace

bool is_color_tag(std::string_view tag)
{
    return tag == "rgb" || tag == "srgb" || tag == "spectrum" || tag == "blackbody" || tag == "float" || tag == "integer";
}

Vec3 read_color(const XmlElement& element, const SceneIndex& index, ColorRole role)
{
    const Vec3 color = read_unchecked(element, index, role);
    const std::string name = element.parameter_name();
    if (!is_finite(color)) throw SceneError(element.where, "'" + name + "' is too large for a 32-bit number");
    const bool negative = color.x < 0 || color.y < 0 || color.z < 0;
    if (role != ColorRole::reflectance) {
        if (negative) throw SceneError(element.where, "'" + name + "' must not be negative");
        return color;
    }
    if (negative || max_component(color) > 1.0f) {
        index.warn(element.where, "'" + name + "' is outside of [0, 1], where energy is conserved, and was clamped", WarningKind::approximated);
        return min(max(color, Vec3{0, 0, 0}), Vec3{1, 1, 1});
    }
    return color;
}

} // namespace sundog
