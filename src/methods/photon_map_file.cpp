#include "methods/photon_map_file.h"

#include "base/checkpoint_file.h"
#include "stages/photon_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace sundog
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* description_name = "photon maps";
constexpr std::uint64_t most_description_bytes = 1 << 20;
constexpr std::uint64_t most_light_paths = std::uint64_t(1) << 48;

Json description_of(const TracedPhotons& map)
{
    return {{"photons", map.photons.size()}, {"light_paths", map.light_paths}};
}

std::span<std::byte> bytes_of(std::vector<Photon>& photons)
{
    return std::as_writable_bytes(std::span(photons));
}

void check_origin(const CheckpointReader& reader, const Json& json, const PhotonMapOrigin& origin)
{
    if (json.at("version") != SUNDOG_VERSION)
        reader.refuse(fmt::format("is of sundog {}, this is {}", json.at("version").get<std::string>(), SUNDOG_VERSION));
    if (json.at("scene") != origin.scene) reader.refuse("is of another scene, or the scene has changed since");
    for (const auto& [name, wanted] : origin.parameters) {
        const auto stored = json.at("parameters").at(name).get<std::string>();
        if (!wanted.empty() && !stored.empty() && stored != wanted)
            reader.refuse(fmt::format("was made with {0}={1}, not {0}={2}: use -p {0}={1}", name, stored, wanted));
    }
}

TracedPhotons read_map(CheckpointReader& reader, const std::string& name, const Json& json, const Bounds& bounds)
{
    const Json &paths = json.at("light_paths"), &photons = json.at("photons");
    const std::uint64_t bytes = reader.next_bytes();
    const bool has_counts = paths.is_number_unsigned() && photons.is_number_unsigned();
    if (!has_counts || paths == 0u || paths >= most_light_paths || bytes % sizeof(Photon) != 0 || photons != bytes / sizeof(Photon))
        reader.refuse(fmt::format("is damaged: its {} map does not hold the photons that it should", name));
    TracedPhotons map;
    map.light_paths = paths.get<std::uint64_t>();
    map.photons.resize(static_cast<std::size_t>(bytes / sizeof(Photon)));
    reader.bytes(name, bytes_of(map.photons));
    for (const Photon& photon : map.photons) reader.check(is_photon(photon, bounds), name);
    return map;
}

} // namespace

void save_photon_maps(const std::filesystem::path& file, const PhotonMapOrigin& origin, const MapPhotons& maps)
{
    Json json{{"version", SUNDOG_VERSION}, {"scene", origin.scene}, {"global", description_of(maps.global)}};
    if (maps.caustic) json["caustic"] = description_of(*maps.caustic);
    for (const auto& [name, value] : origin.parameters) json["parameters"][name] = value;
    CheckpointWriter writer(file);
    writer.text(description_name, json.dump());
    MapPhotons copy = maps; // an archive takes what it could also restore
    writer.bytes("global", bytes_of(copy.global.photons));
    if (copy.caustic) writer.bytes("caustic", bytes_of(copy.caustic->photons));
    writer.commit();
}

MapPhotons load_photon_maps(const std::filesystem::path& file, const PhotonMapOrigin& origin, const Bounds& bounds)
{
    CheckpointReader reader(file, {"photon map", "cannot load photon maps", "trace them again (-p save_map=FILE, no load_map)"});
    try {
        const Json json = Json::parse(reader.text(description_name, most_description_bytes));
        check_origin(reader, json, origin);
        MapPhotons maps{read_map(reader, "global", json.at("global"), bounds), {}};
        if (json.contains("caustic")) maps.caustic = read_map(reader, "caustic", json.at("caustic"), bounds);
        reader.finish();
        return maps;
    } catch (const Json::exception& error) {
        reader.refuse(fmt::format("does not describe its maps ({})", error.what()));
    }
}

} // namespace sundog
