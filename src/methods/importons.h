// Importons: camera paths traced ahead of the photons, to find where those matter.
#pragma once

#include "methods/parameters.h"
#include "methods/render_context.h"
#include "stages/importance_map.h"

#include <memory>

namespace sundog
{

ParameterSpec importons_spec();

// nullptr where the parameters ask for none. rays: that it took.
std::unique_ptr<ImportanceMap> trace_importons(RenderContext& context, const Parameters& parameters, std::uint64_t& rays);

} // namespace sundog
