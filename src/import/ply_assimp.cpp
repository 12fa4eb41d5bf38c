#include "import/ply.h"

#include "import/ply_check.h"
#include "import/text_file.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace sundog
{

namespace
{

Vec3 to_vec3(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

void append(const aiMesh& source, TriangleMesh& mesh)
{
    const auto base = static_cast<uint>(mesh.positions.size());
    for (unsigned i = 0; i < source.mNumVertices; i++) mesh.positions.push_back(to_vec3(source.mVertices[i]));
    if (source.HasNormals()) {
        mesh.normals.resize(base, Vec3{0, 0, 0});
        for (unsigned i = 0; i < source.mNumVertices; i++) mesh.normals.push_back(to_vec3(source.mNormals[i]));
    }
    for (unsigned i = 0; i < source.mNumFaces; i++) {
        const aiFace& face = source.mFaces[i];
        if (face.mNumIndices == 3) mesh.triangles.push_back({base + face.mIndices[0], base + face.mIndices[1], base + face.mIndices[2]});
    }
}

} // namespace

TriangleMesh load_ply(const std::filesystem::path& file, const SourceLocation& wanted_at)
{
    const std::string content = read_text_file(file, wanted_at);
    check_ply(file, content);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(content.data(), content.size(), aiProcess_Triangulate, "ply");
    if (!scene) {
        const std::string reason = importer.GetErrorString();
        throw SceneError({file.string(), 0}, "malformed PLY: " + reason.substr(0, reason.find('\n')));
    }
    TriangleMesh mesh;
    for (unsigned i = 0; i < scene->mNumMeshes; i++) append(*scene->mMeshes[i], mesh);
    if (!mesh.normals.empty()) mesh.normals.resize(mesh.positions.size(), Vec3{0, 0, 0});
    return mesh;
}

} // namespace sundog
