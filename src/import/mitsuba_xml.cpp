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

void import_objects(const XmlScene& xml, const SceneIndex& index, std::uint64_t texture_bytes, Scene& scene)
{
    ObjectReader root(xml.root, index);

    const auto sensors = root.nested("sensor");
    if (sensors.empty()) throw SceneError({xml.file, 0}, "the scene has no <sensor>: add one, as in <sensor type=\"perspective\">");
    if (sensors.size() > 1) index.warn(sensors[1].where, "the scene has several sensors; only the first is rendered", WarningKind::ignored);
    import_sensor(*sensors.front().object, index, scene);

    if (const auto integrator = root.single("integrator")) import_integrator(*integrator->object, index, scene.integrator);

    TextureImporter textures(index, scene.textures, texture_bytes);
    BsdfImporter bsdfs(index, textures, scene.bsdfs);
    InstanceImporter instances(index, bsdfs, textures, scene);
    for (const auto& shape : root.nested("shape"))
        if (!instances.import(*shape.object)) import_shape(*shape.object, index, bsdfs, textures, scene);
    instances.finish();
    for (const auto& emitter : root.nested("emitter")) scene.emitters.push_back(import_emitter(*emitter.object, index, textures));
    textures.bitmaps().warn_of_scaled_down();

    // Declared for those who refer to them, who complain about what they cannot use.
    for (const char* tag : {"bsdf", "texture", "medium", "volume", "phase"}) root.nested(tag);
    root.finish();
}

} // namespace

LoadedScene load_scene(const std::filesystem::path& file, const LoadOptions& options)
{
    LoadedScene loaded;
    loaded.scene.file = file.string();
    const XmlScene xml = read_scene_xml(file, options.defines, loaded.warnings);
    const SceneIndex index(xml, loaded.warnings);
    import_objects(xml, index, options.texture_bytes, loaded.scene);
    validate_scene(loaded.scene, loaded.warnings);
    return loaded;
}

} // namespace sundog
