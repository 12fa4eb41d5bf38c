// Specular vertices before a light: path space regularization [Kaplanyan and Dachsbacher 2013].
#pragma once

#include "device/kernel.h"
#include "shared/regularization.h"

namespace sundog
{

// Specialises kernels that shade camera paths.
inline void use_regularization(BuildOptions& options)
{
    options.defines.emplace_back("REGULARIZED", "1");
}

} // namespace sundog
