// BSDFs as the device's records.
#pragma once

#include "scene/scene.h"
#include "shared/bsdf.h"
#include "shared/principled.h"

#include <span>
#include <vector>

namespace sundog {

// One record a description, in the same order.
std::vector<Bsdf> flatten_bsdfs(const std::vector<BsdfDescription>& descriptions);
// Of the principled ones among them, in the same order.
std::vector<Principled> flatten_principled(const std::vector<BsdfDescription>& descriptions);

TexturedColor flatten(const ColorSource& color);
TexturedNumber flatten(const NumberSource& number);

// Whether some index depends on the wavelength.
bool has_dispersion(std::span<const Bsdf> bsdfs);

// Bit t is set where there are BSDFs of type t: what kernels are specialised for.
uint bsdf_types(std::span<const Bsdf> bsdfs);

// The same for lobes.
uint lobe_types(std::span<const Bsdf> bsdfs);

// Whether light may be focused: some lobe is not as broad as a diffuse one.
bool has_focusing_lobes(std::span<const Bsdf> bsdfs);

// Whether a query may meet a lobe whose value depends on where a photon comes from.
bool has_lobes_to_evaluate(std::span<const Bsdf> bsdfs);

} // namespace sundog
