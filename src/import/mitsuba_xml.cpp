#include "import/mitsuba_xml.h"

#include "import/bsdf_import.h"
#include "import/emitter_import.h"
#include "import/instance_import.h"
#include "import/integrator_import.h"
#include "import/sensor_import.h"
#include "import/shape_import.h"
#include "import/texture_budget.h"
#include "scene/validate.h"

namespace sundog
{

namespace
{

void import_objects(const XmlScene& xml, const SceneIndex& index, Scene& scene)
{
    ObjectReader root(xml.root, index);

    const auto sensors = root.nested("sensor");
    if (sensors.empty()) throw SceneError({xml.file, 0}, "the scene has no <sensor>: add one, as in <sensor type=\"perspective\">");
    if (sensors.size() > 1) index.warn(sensors[1].where, "the scene has several sensors; only the first is rendered", WarningKind::ignored);
    import_sensor(*sensors.front().object, index, scene);

    if (const auto integrator = root.single("integrator")) import_integrator(*integrator->object, index, scene.integrator);

    TextureImporter textures(index, scene.textures);
    BsdfImporter bsdfs(index, textures, scene.bsdfs);
    InstanceImporter instances(index, bsdfs, textures, scene);
    for (const auto& shape : root.nested("shape"))
        if (!instances.import(*shape.object)) import_shape(*shape.object, index, bsdfs, textures, scene);
    instances.finish();
    for (const auto& emitter : root.nested("emitter")) scene.emitters.push_back(import_emitter(*emitter.object, index, textures));

    // Declared for those who refer to them, who complain about what they cannot use.
    for (const char* tag : {"bsdf", "texture", "medium", "volume", "phase"}) root.nested(tag);
    root.finish();
}

// Once more, from a nearer origin, where the first has shown that the scene is far from it.
Scene import_scene(const XmlScene& xml, const std::string& file, std::vector<Warning>& warnings)
{
    constexpr int attempts = 4; // each knows better where a scene is that the last one saw in coarse steps
    const std::vector<Warning> before = warnings;
    LocalOrigins origins;
    for (int attempt = 1;; attempt++) {
        warnings = before;
        const SceneIndex index(xml, warnings, origins);
        Scene scene;
        scene.file = file;
        scene.origin = origins.world.place;
        std::optional<LocalOrigins> nearer;
        try {
            import_objects(xml, index, scene);
            nearer = nearer_origins(origins, scene);
        } catch (const LostFarAway& lost) {
            if (attempt == attempts) throw;
            nearer = nearer_origins(origins, lost);
        }
        if (!nearer || attempt == attempts) return scene;
        origins = *nearer;
    }
}

} // namespace

LoadedScene load_scene(const std::filesystem::path& file, const LoadOptions& options)
{
    LoadedScene loaded;
    const XmlScene xml = read_scene_xml(file, options.defines, loaded.warnings);
    loaded.scene = import_scene(xml, file.string(), loaded.warnings);
    warn_of_places(loaded.scene, loaded.warnings);
    fit_texture_budget(loaded.scene, options.texture_bytes, loaded.warnings);
    validate_scene(loaded.scene, loaded.warnings);
    return loaded;
}

} // namespace sundog
