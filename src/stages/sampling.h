// Which random numbers a pass uses.
#pragma once

#include "device/kernel.h"
#include "shared/markov_chain.h"
#include "shared/sampler.h"

#include <cstdint>
#include <string>

namespace sundog {

// chain: numbers that Markov chains propose (stages/markov_chains.h).
enum class SamplerKind { independent = SAMPLER_INDEPENDENT, sobol = SAMPLER_SOBOL, chain = SAMPLER_CHAIN };

// Specialises kernels that draw random numbers.
inline void use_sampler(BuildOptions& options, SamplerKind kind)
{
    options.defines.emplace_back("SAMPLER", std::to_string(static_cast<int>(kind)));
}

inline SamplerKey sampler_key(std::uint64_t seed, std::uint64_t iteration)
{
    return {static_cast<uint>(seed), static_cast<uint>(seed >> 32), static_cast<uint>(iteration), static_cast<uint>(iteration >> 32)};
}

// Markov chains as kernels see them (kernels/math/chain_numbers.h).
struct ChainNumbers {
    const Buffer<MarkovChain>* chains = nullptr;
    const Buffer<uint>* coordinates = nullptr;
    uint stored_blocks = 0;
};

// Argument for SAMPLER_PARAMETERS: a key, and with it the chains where kernels are built for them.
struct SamplerSource {
    SamplerSource(SamplerKey the_key) : key(the_key) {}
    SamplerSource(SamplerKey the_key, ChainNumbers the_chains) : key(the_key), chains(the_chains) {}

    SamplerKey key;
    ChainNumbers chains;
};

inline void bind(ArgumentBinder& binder, const SamplerSource& source)
{
    bind(binder, source.key);
    if (!source.chains.chains) return;
    bind(binder, *source.chains.chains);
    bind(binder, *source.chains.coordinates);
    bind(binder, source.chains.stored_blocks);
}

} // namespace sundog
