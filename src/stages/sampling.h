// Which random numbers a pass uses.
#pragma once

#include "device/kernel.h"
#include "shared/sampler.h"

#include <cstdint>
#include <string>

namespace sundog {

enum class SamplerKind { independent, sobol };

// Specialises kernels that draw random numbers.
inline void use_sampler(BuildOptions& options, SamplerKind kind)
{
    options.defines.emplace_back("SAMPLER", std::to_string(kind == SamplerKind::sobol ? SAMPLER_SOBOL : SAMPLER_INDEPENDENT));
}

inline SamplerKey sampler_key(std::uint64_t seed, std::uint64_t iteration)
{
    return {static_cast<uint>(seed), static_cast<uint>(seed >> 32), static_cast<uint>(iteration), static_cast<uint>(iteration >> 32)};
}

} // namespace sundog
