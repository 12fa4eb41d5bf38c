// Spectra that a scene file gives by samples.
#pragma once

#include "import/scene_index.h"
#include "scene/spectrum.h"

#include <vector>

namespace sundog
{

using SpectrumSamples = std::vector<SpectrumSample>;

// All throw SceneError for fewer than two samples, wavelengths that do not increase, and negative values.

// "400:0.1, 500:0.2", as words.
SpectrumSamples parse_spectrum_pairs(const XmlElement& element, const std::vector<std::string_view>& pairs);

// Lines of a wavelength (nm) and a value; # starts a comment.
SpectrumSamples read_spectrum_file(const std::filesystem::path& file, const SourceLocation& where);

// As many wavelengths as values.
SpectrumSamples spectrum_of(const std::vector<double>& wavelengths, const std::vector<double>& values, const SourceLocation& where);

} // namespace sundog
