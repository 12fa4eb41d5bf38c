#include "import/mitsuba_xml.h"

#include "import/bsdf_import.h"
#include "import/emitter_import.h"
#include "import/instance_import.h"
#include "import/integrator_import.h"
#include "import/sensor_import.h"
#include "import/shape_import.h"
#include "scene/validate.h"

namespace sundog
{

namespace
{

// An area emitter beside the shapes, which take it by <ref>.
bool is_declared_for_shapes(const XmlElement& emitter, const SceneIndex& index)
{
    const std::string* type = emitter.attribute("type");
    return type && *type == "area" && index.is_referenced(emitter);
}

// Samplers, films and filters may stand in the scene for sensors and films to refer to.
void declare_parts_of_sensors(ObjectReader& root)
{
    for (const char* tag : {"sampler", "film", "rfilter"})
        for (const NestedObject& part : root.nested(tag))
            if (!root.index().is_referenced(*part.object))
                root.index().warn(part.where, ObjectReader(*part.object, root.index()).describe() + " is ignored: no sensor contains it or refers to it",
                                  WarningKind::ignored);
}

void import_objects(const XmlScene& xml, const SceneIndex& index, std::uint64_t texture_bytes, Scene& scene)
{
    ObjectReader root(xml.root, index);

    const auto sensors = root.nested("sensor");
    if (sensors.empty()) throw SceneError({xml.file, 0}, "the scene has no <sensor>: add one, as in <sensor type=\"perspective\">");
    if (sensors.size() > 1) index.warn(sensors[1].where, "the scene has several sensors; only the first is rendered", WarningKind::ignored);
    import_sensor(*sensors.front().object, index, scene);

    TextureImporter textures(index, scene.textures, texture_bytes);
    BsdfImporter bsdfs(index, textures, scene.bsdfs);
    InstanceImporter instances(index, bsdfs, textures, scene);
    for (const auto& shape : root.nested("shape"))
        if (!instances.import(*shape.object)) import_shape(*shape.object, index, bsdfs, textures, scene);
    instances.finish();
    for (const auto& emitter : root.nested("emitter"))
        if (!is_declared_for_shapes(*emitter.object, index))
            if (auto imported = import_emitter(*emitter.object, index, textures)) scene.emitters.push_back(std::move(*imported));
    if (const auto integrator = chosen_integrator(root))
        import_integrator(*integrator->object, index, scene.bounds().radius(), scene.integrator);
    textures.bitmaps().warn_of_scaled_down();

    // Declared for those who refer to them, who complain about what they cannot use.
    for (const char* tag : {"bsdf", "texture", "medium", "volume", "phase"}) root.nested(tag);
    declare_parts_of_sensors(root);
    root.finish();
}

// Once more, from a nearer origin, where the first has shown that the scene is far from it.
void import_scene(const XmlScene& xml, const std::string& file, const LoadOptions& options, LoadedScene& loaded)
{
    constexpr int attempts = 4; // each knows better where a scene is that the last one saw in coarse steps
    const std::vector<Warning> before = loaded.warnings;
    LocalOrigins origins;
    for (int attempt = 1;; attempt++) {
        loaded.warnings = before;
        const SceneIndex index(xml, loaded.warnings, origins, options.allow_missing);
        Scene scene;
        scene.file = file;
        scene.origin = origins.world.place;
        std::optional<LocalOrigins> nearer;
        try {
            import_objects(xml, index, options.texture_bytes, scene);
            nearer = nearer_origins(origins, scene);
        } catch (const LostFarAway& lost) {
            if (attempt == attempts) throw;
            nearer = nearer_origins(origins, lost);
        }
        if (!nearer || attempt == attempts) {
            loaded.scene = std::move(scene);
            loaded.files = xml.included;
            loaded.files.insert(loaded.files.end(), index.files().begin(), index.files().end());
            return;
        }
        origins = *nearer;
    }
}

} // namespace

LoadedScene load_scene(const std::filesystem::path& file, const LoadOptions& options)
{
    LoadedScene loaded;
    const XmlScene xml = read_scene_xml(file, options.defines, loaded.warnings);
    import_scene(xml, file.string(), options, loaded);
    warn_of_places(loaded.scene, loaded.warnings);
    validate_scene(loaded.scene, loaded.warnings);
    return loaded;
}

} // namespace sundog
