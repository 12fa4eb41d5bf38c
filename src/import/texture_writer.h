// Textures of a scene file that is written.
#pragma once

#include "import/object_writer.h"
#include "import/written_files.h"
#include "import/written_ids.h"

namespace sundog
{

class TextureWriter
{
public:
    TextureWriter(const Scene& scene, WrittenIds& ids, WrittenFiles& files);

    // Declares all textures in `root`, for the parameters to refer to.
    void write_all(ObjectWriter root);
    // After all that may use them: throws SceneError for one that nothing uses, which a reader leaves out.
    void check_all_used() const;

    // Parameters of the objects that use them.
    void color(ObjectWriter object, const char* name, const ColorSource& source) const;
    void number(ObjectWriter object, const char* name, const NumberSource& source) const;

    // Of its image, width over height; 1 for none.
    double aspect(const std::optional<uint>& texture) const { return texture ? scene_.textures[*texture].aspect() : 1.0; }

private:
    void scaled(ObjectWriter object, const char* name, uint texture, Vec3 factor) const;
    // One of each alternative of TextureDescription::model.
    void write(ObjectWriter root, const std::string& id, const TextureDescription& texture, const BitmapTexture& bitmap);
    void write(ObjectWriter root, const std::string& id, const TextureDescription& texture, const CheckerboardTexture& checkerboard);
    void write(ObjectWriter root, const std::string& id, const TextureDescription& texture, const AttributeTexture& attribute);

    const Scene& scene_;
    WrittenFiles& files_;
    std::vector<std::string> ids_; // of scene_.textures
    mutable std::vector<bool> used_; // the same
};

} // namespace sundog
