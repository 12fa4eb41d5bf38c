#include "methods/memory_demand.h"

#include "base/errors.h"
#include "device/device.h"
#include "device/memory_account.h"
#include "methods/render_context.h"

#include <fmt/format.h>

namespace sundog
{

namespace
{

double bytes_for(const ParameterSpec& spec, const Parameters& parameters, std::size_t pixels)
{
    const double factor = spec.is_per_pixel ? static_cast<double>(pixels) : 1.0;
    return spec.device_bytes > 0.0 ? spec.device_bytes * factor * static_cast<double>(parameters.integer(spec.name)) : 0.0;
}

// The parameter that the user set and that asks for most; none: the film or the scene is too large.
const ParameterSpec* greatest_demand(const MethodInfo& info, const Parameters& parameters, std::size_t pixels)
{
    const ParameterSpec* greatest = nullptr;
    for (const ParameterSpec& spec : info.parameters) {
        if (!parameters.is_set(spec.name) || bytes_for(spec, parameters, pixels) == 0.0) continue;
        if (!greatest || bytes_for(spec, parameters, pixels) > bytes_for(*greatest, parameters, pixels)) greatest = &spec;
    }
    return greatest;
}

} // namespace

void refuse_beyond_memory(const MethodInfo& info, const Parameters& parameters, double memory_bytes, std::size_t pixels)
{
    const ParameterSpec* greatest = greatest_demand(info, parameters, pixels);
    if (!greatest) return;
    const double bytes = bytes_for(*greatest, parameters, pixels);
    if (bytes > memory_bytes)
        throw DeviceError(fmt::format("{}={} needs {} of memory or more, and the device has {}; give a smaller number", greatest->name,
                                      parameters.text(greatest->name), format_bytes(static_cast<std::uint64_t>(bytes)),
                                      format_bytes(static_cast<std::uint64_t>(memory_bytes))));
}

std::unique_ptr<Method> create_method(const MethodInfo& info, RenderContext& context, const Parameters& parameters)
{
    const std::size_t pixels = context.film.pixel_count();
    refuse_beyond_memory(info, parameters, static_cast<double>(context.device.info().memory_bytes), pixels);
    try {
        return info.create(context, parameters);
    } catch (const OutOfDeviceMemory& error) {
        const ParameterSpec* greatest = greatest_demand(info, parameters, pixels);
        if (!greatest) throw;
        parameters.refuse(greatest->name, fmt::format("{}={} needs more memory than there is: {}", greatest->name, parameters.text(greatest->name), error.what()));
    }
}

} // namespace sundog
