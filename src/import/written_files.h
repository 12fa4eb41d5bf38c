// Files beside a scene file that is written: meshes and images.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>

namespace sundog
{

class WrittenFiles
{
public:
    // `folder` is made with the first file, in a folder that exists.
    explicit WrittenFiles(const std::filesystem::path& folder) : folder_(folder) {}

    // Each returns the file's name relative to where `folder` is, for a scene file there. Throws FileError.
    std::string add_mesh(const TriangleMesh& mesh, std::size_t shape);
    std::string add_image(const std::shared_ptr<const TexelImage>& image); // once, however often it is added

private:
    std::string add(const std::string& name, std::string_view bytes);

    std::filesystem::path folder_;
    std::map<const TexelImage*, std::string> images_;
};

} // namespace sundog
