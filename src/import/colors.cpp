#include "import/colors.h"

#include "import/limits.h"
#include "import/spectrum_samples.h"
#include "import/text_file.h"
#include "import/values.h"
#include "math/srgb.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace sundog
{

namespace
{

Vec3 reduce(const SpectrumSamples& samples, ColorRole role)
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

// Numbers in a <string>.
std::vector<double> read_list(ObjectReader& reader, const char* name)
{
    const std::string text = reader.text(name, "");
    std::vector<double> list;
    for (const std::string_view word : tokens(text)) {
        const auto number = parse_number(word);
        if (!number) throw SceneError(reader.where_of(name), "'" + std::string(name) + "' of a spectrum must be numbers, got '" + std::string(word) + "'");
        list.push_back(*number);
    }
    return list;
}

SpectrumSamples read_irregular(ObjectReader& reader)
{
    if (reader.has("filename")) return read_spectrum_file(reader.index().find_file(reader.text("filename", ""), reader.where_of("filename")), reader.where());
    return spectrum_of(read_list(reader, "wavelengths"), read_list(reader, "values"), reader.where());
}

// Evenly spaced between two wavelengths.
SpectrumSamples read_regular(ObjectReader& reader)
{
    const double shortest = reader.number("wavelength_min", 360.0), longest = reader.number("wavelength_max", 830.0);
    const std::vector<double> values = read_list(reader, "values");
    std::vector<double> wavelengths;
    for (std::size_t i = 0; i < values.size(); i++)
        wavelengths.push_back(shortest + (longest - shortest) * static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(values.size(), 2) - 1));
    return spectrum_of(wavelengths, values, reader.where());
}

double required_number(ObjectReader& reader, const char* name)
{
    if (!reader.has(name)) throw SceneError(reader.where(), reader.describe() + " needs a <float name=\"" + name + "\">");
    return reader.number(name, 0.0);
}

// <spectrum type="..."> with parameters inside.
Vec3 read_spectrum_object(const XmlElement& element, const SceneIndex& index, ColorRole role)
{
    ObjectReader reader(element, index);
    const std::string type = reader.type();
    const auto scale = [&] { return static_cast<float>(reader.number("scale", 1.0)); };
    Vec3 color;
    if (type == "blackbody") {
        required_number(reader, "temperature");
        color = blackbody_to_rgb(kelvins(*reader.find("temperature"), *reader.find("temperature")->attribute("value"))) * scale();
    } else if (type == "uniform") {
        color = gray(required_number(reader, "value")) * scale();
    } else if (type == "d65") { // white, and white light of a colour is that colour
        color = reader.color("color", {1, 1, 1}, ColorRole::emission) * scale();
    } else if (type == "srgb") {
        color = reader.color("color", {1, 1, 1}, role);
    } else if (type == "irregular") {
        color = reduce(read_irregular(reader), role);
    } else if (type == "regular") {
        color = reduce(read_regular(reader), role);
    } else {
        reader.unsupported("blackbody, d65, irregular, regular, srgb, uniform");
    }
    reader.finish();
    return color;
}

Vec3 read_spectrum(const XmlElement& element, const SceneIndex& index, ColorRole role)
{
    if (element.attribute("type")) return read_spectrum_object(element, index, role);
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
    // Red, green and blue, as in Mitsuba 0.6 where it was built for RGB.
    if (words.size() == 3 && value->find(':') == std::string::npos) return read_rgb(element);
    return reduce(parse_spectrum_pairs(element, words), role);
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
        if (role == ColorRole::emission) check_emission(color, element.where, name);
        return color;
    }
    if (negative || max_component(color) > 1.0f) {
        index.warn(element.where, "'" + name + "' is outside of [0, 1], where energy is conserved, and was clamped", WarningKind::approximated);
        return min(max(color, Vec3{0, 0, 0}), Vec3{1, 1, 1});
    }
    return color;
}

} // namespace sundog
