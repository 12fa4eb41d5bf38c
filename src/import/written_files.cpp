#include "import/written_files.h"

#include "base/atomic_file.h"
#include "import/bitmap.h"
#include "import/ply_writer.h"

namespace sundog
{

std::string WrittenFiles::add_mesh(const TriangleMesh& mesh, std::size_t shape)
{
    return add("mesh-" + std::to_string(shape) + ".ply", ply_bytes(mesh));
}

std::string WrittenFiles::add_image(const std::shared_ptr<const TexelImage>& image)
{
    std::string& name = images_[image.get()];
    if (name.empty()) {
        const std::string ending = image->words_per_texel() > 1 ? ".exr" : ".png";
        const std::string file = "image-" + std::to_string(images_.size() - 1) + ending;
        name = add(file, encode_bitmap(*image, folder_ / file));
    }
    return name;
}

std::string WrittenFiles::add(const std::string& name, std::string_view bytes)
{
    std::error_code failed;
    std::filesystem::create_directory(folder_, failed);
    if (failed) throw FileError(folder_.string() + ": cannot make the folder: " + failed.message());
    write_file(folder_ / name, bytes);
    return (folder_.filename() / name).generic_string();
}

} // namespace sundog
