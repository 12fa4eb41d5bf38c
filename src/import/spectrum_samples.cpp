#include "import/spectrum_samples.h"

#include "import/text_file.h"

#include <sstream>

namespace sundog
{

namespace
{

void check_samples(const SpectrumSamples& samples, const SourceLocation& where)
{
    if (samples.size() < 2) throw SceneError(where, "a spectrum needs at least two wavelength:value pairs");
    for (std::size_t i = 0; i < samples.size(); i++) {
        if (i > 0 && samples[i].wavelength <= samples[i - 1].wavelength)
            throw SceneError(where, "the wavelengths of a spectrum must increase");
        if (samples[i].value < 0.0) throw SceneError(where, "a spectrum must not have negative values");
    }
}

} // namespace

SpectrumSamples parse_spectrum_pairs(const XmlElement& element, const std::vector<std::string_view>& pairs)
{
    SpectrumSamples samples;
    for (std::string_view pair : pairs) {
        const std::size_t colon = pair.find(':');
        const auto wavelength = parse_number(pair.substr(0, colon));
        const auto value = colon == std::string_view::npos ? std::nullopt : parse_number(pair.substr(colon + 1));
        if (!wavelength || !value)
            throw SceneError(element.where, "a spectrum must be one number, three (red, green, blue) or pairs wavelength:value, got '" + std::string(pair) + "'");
        samples.push_back({*wavelength, *value});
    }
    check_samples(samples, element.where);
    return samples;
}

SpectrumSamples read_spectrum_file(const std::filesystem::path& file, const SourceLocation& where)
{
    std::istringstream content(read_text_file(file, where));
    SpectrumSamples samples;
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

SpectrumSamples spectrum_of(const std::vector<double>& wavelengths, const std::vector<double>& values, const SourceLocation& where)
{
    if (wavelengths.size() != values.size())
        throw SceneError(where, "a spectrum must have as many values as wavelengths, got " + std::to_string(values.size()) + " and " +
                                    std::to_string(wavelengths.size()));
    SpectrumSamples samples;
    for (std::size_t i = 0; i < values.size(); i++) samples.push_back({wavelengths[i], values[i]});
    check_samples(samples, where);
    return samples;
}

} // namespace sundog
