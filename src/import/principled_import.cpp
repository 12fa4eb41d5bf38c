#include "import/principled_import.h"

#include "import/limits.h"

#include <cmath>

namespace sundog
{

namespace
{

constexpr double max_specular = 12.0; // at 12.5 the index is infinite

// The index whose reflectance along the normal is 0.08 `specular` [Burley 2012, section 5.5].
float index_of(double specular)
{
    return static_cast<float>(2.0 / (1.0 - std::sqrt(0.08 * specular)) - 1.0);
}

// Glass needs an interface: without one Mitsuba takes the least index or specular that it can tell from none.
float read_index(ObjectReader& reader, bool transmits)
{
    if (reader.has("eta") && reader.has("specular"))
        throw SceneError(reader.where_of("specular"), "give a principled bsdf either eta or specular, not both");
    if (reader.has("eta")) {
        const float eta = static_cast<float>(reader.positive("eta", 1.5));
        check_relative_index(eta, reader.where_of("eta"));
        return transmits && eta == 1.0f ? 1.001f : eta;
    }
    const double specular = reader.number("specular", 0.5);
    if (!(specular >= 0.0 && specular <= max_specular))
        throw SceneError(reader.where_of("specular"), "'specular' must be between 0 and 12 (0.5 is an index of 1.5)");
    return index_of(transmits && specular == 0.0 ? 1e-3 : specular);
}

} // namespace

PrincipledBsdf read_principled(ObjectReader& reader, TextureImporter& textures)
{
    PrincipledBsdf bsdf;
    bsdf.base_color = textures.color(reader, "base_color", bsdf.base_color.value, ColorRole::reflectance);
    for (const PrincipledNumber& number : principled_numbers) {
        NumberSource& source = bsdf.*number.member;
        source = textures.number(reader, number.name, source.value, 0.0, 1.0);
    }
    bsdf.eta = read_index(reader, bsdf.transmits());
    for (const char* name : {"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate", "clearcoat_sampling_rate"})
        reader.ignore(name, "lobes are chosen by how much light they reflect");
    return bsdf;
}

} // namespace sundog
