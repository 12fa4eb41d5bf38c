#include "scene/materials.h"

#include <algorithm>
#include <cctype>

namespace sundog
{

namespace
{

struct NamedIor {
    const char* name;
    float ior;
};

constexpr NamedIor iors[] = {
    {"vacuum", 1.0f},      {"helium", 1.000036f},        {"hydrogen", 1.000132f},
    {"air", 1.000277f},    {"carbon dioxide", 1.00045f}, {"water", 1.333f},
    {"acetone", 1.36f},    {"ethanol", 1.361f},          {"carbon tetrachloride", 1.461f},
    {"glycerol", 1.4729f}, {"benzene", 1.501f},          {"silicone oil", 1.52045f},
    {"bromine", 1.661f},   {"water ice", 1.31f},         {"fused quartz", 1.458f},
    {"pyrex", 1.47f},      {"acrylic glass", 1.49f},     {"polypropylene", 1.49f},
    {"bk7", 1.5046f},      {"sodium chloride", 1.544f},  {"amber", 1.55f},
    {"pet", 1.575f},       {"diamond", 2.419f},
};

struct NamedConductor {
    const char* name;
    ConductorConstants constants;
};

// Tabulated n and k of the Luxpop collection and [Palik 1998, Handbook of Optical Constants of Solids], integrated
// against the CIE 1931 curves into linear sRGB without white balance, as Mitsuba's RGB modes do, so that a metal
// looks the same in both. They are coefficients of a colour space, not the index at any one wavelength, and
// those out of its gamut are (all but) 0.
constexpr NamedConductor conductors[] = {
    {"none", {{0, 0, 0}, {1, 1, 1}}},
    {"a-C", {{2.94410f, 2.22715f, 1.96817f}, {0.88743f, 0.79932f, 0.81529f}}},
    {"Ag", {{0.15526f, 0.11672f, 0.13838f}, {4.82834f, 3.12225f, 2.14695f}}},
    {"Al", {{1.65746f, 0.88037f, 0.52123f}, {9.22387f, 6.26952f, 4.83700f}}},
    {"Au", {{0.14312f, 0.37496f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}}},
    {"Be", {{4.18506f, 3.18506f, 2.78409f}, {3.83544f, 3.01013f, 2.86901f}}},
    {"Cr", {{4.36968f, 2.91670f, 1.65470f}, {5.20643f, 4.23136f, 3.75495f}}},
    {"Cu", {{0.20044f, 0.92403f, 1.10221f}, {3.91295f, 2.45285f, 2.14219f}}},
    {"Cu_palik", {{0.21268f, 0.91999f, 1.10241f}, {3.92156f, 2.45715f, 2.13665f}}},
    {"Hg", {{2.39893f, 1.44003f, 0.90955f}, {6.32763f, 4.37194f, 3.42179f}}},
    {"Ir", {{3.08641f, 2.08219f, 1.61789f}, {5.59215f, 4.06718f, 3.26726f}}},
    {"K", {{0.06405f, 0.04641f, 0.03818f}, {2.10422f, 1.34894f, 0.91321f}}},
    {"Li", {{0.26579f, 0.19561f, 0.22092f}, {3.54017f, 2.31113f, 1.66859f}}},
    {"Mo", {{4.48370f, 3.52546f, 2.77608f}, {4.11113f, 3.42087f, 3.15060f}}},
    {"Na", {{0.06027f, 0.05614f, 0.06199f}, {3.17929f, 2.11248f, 1.57909f}}},
    {"Nb", {{3.42014f, 2.79019f, 2.39559f}, {3.44138f, 2.73764f, 2.57991f}}},
    {"Ni", {{2.36728f, 1.66336f, 1.46706f}, {4.49883f, 3.05016f, 2.34543f}}},
    {"Rh", {{2.58580f, 1.86019f, 1.55443f}, {6.78229f, 4.70295f, 3.97609f}}},
    {"Ta", {{2.06258f, 2.39309f, 2.62803f}, {2.40805f, 1.74137f, 1.94704f}}},
    {"TiC", {{3.70047f, 2.83744f, 2.58230f}, {3.26569f, 2.35156f, 2.17279f}}},
    {"TiN", {{1.64847f, 1.15045f, 1.37978f}, {3.36846f, 1.94349f, 1.10201f}}},
    {"V", {{4.27751f, 3.51315f, 2.76113f}, {3.49118f, 2.88936f, 3.11170f}}},
    {"VC", {{3.65757f, 2.75273f, 2.53268f}, {3.06835f, 2.19869f, 1.96318f}}},
    {"VN", {{2.86560f, 2.11918f, 1.94008f}, {3.03233f, 2.05611f, 1.61629f}}},
    {"W", {{4.37070f, 3.30030f, 2.99827f}, {3.50068f, 2.60487f, 2.27319f}}},
    {"AlAs", {{3.60530f, 3.23294f, 2.21632f}, {0.00068f, 0.00000f, 0.00751f}}},
    {"AlSb", {{0.00001f, 4.13937f, 4.66925f}, {0.00000f, 0.09401f, 1.30057f}}},
    {"CsI", {{2.14490f, 1.70232f, 1.66243f}, {0.00000f, 0.00000f, 0.00000f}}},
    {"Cu2O", {{3.55177f, 2.94987f, 2.75188f}, {0.11421f, 0.19390f, 0.60613f}}},
    {"CuO", {{3.24754f, 2.44781f, 2.21022f}, {0.52109f, 0.57003f, 0.72218f}}},
    {"d-C", {{2.70872f, 2.31883f, 2.22890f}, {0.00000f, 0.00000f, 0.00000f}}},
    {"HgTe", {{4.77904f, 3.23120f, 2.65990f}, {1.63161f, 1.58081f, 1.72929f}}},
    {"MgO", {{2.08958f, 1.65072f, 1.59488f}, {0.00000f, 0.00000f, 0.00000f}}},
    {"Se", {{4.05831f, 2.84294f, 2.82085f}, {0.75405f, 0.63844f, 0.52181f}}},
    {"SiC", {{3.17234f, 2.52597f, 2.47937f}, {0.00000f, 0.00000f, 0.00001f}}},
    {"SnTe", {{4.52425f, 1.98164f, 1.28159f}, {0.00000f, 0.00000f, 0.00000f}}},
    {"Te", {{7.39023f, 4.48210f, 2.63711f}, {3.25602f, 3.52706f, 3.29205f}}},
    {"ThF4", {{1.83071f, 1.44223f, 1.38765f}, {0.00000f, 0.00000f, 0.00000f}}},
    {"TiO2", {{3.45661f, 2.80174f, 2.90517f}, {0.00011f, 0.00000f, 0.00065f}}},
};

template <typename Table> std::string names_of(const Table& table)
{
    std::string names;
    for (const auto& entry : table) names += (names.empty() ? "" : ", ") + std::string(entry.name);
    return names;
}

} // namespace

std::optional<float> find_ior(std::string_view name)
{
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const auto& entry : iors)
        if (lower == entry.name) return entry.ior;
    return {};
}

std::optional<ConductorConstants> find_conductor(std::string_view name)
{
    for (const auto& entry : conductors)
        if (name == entry.name) return entry.constants;
    // The same measurements under the name of their collection.
    constexpr std::string_view suffix = "_palik";
    if (name.ends_with(suffix)) return find_conductor(name.substr(0, name.size() - suffix.size()));
    return {};
}

std::string ior_names()
{
    return names_of(iors);
}

std::string conductor_names()
{
    return names_of(conductors);
}

} // namespace sundog
