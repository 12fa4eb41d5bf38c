// Scenes of one mesh file.
#pragma once

#include "unit/scene_folder.h"

namespace sundog::testing
{

inline const TriangleMesh& mesh_of(const LoadedScene& loaded, std::size_t shape = 0)
{
    return std::get<TriangleMesh>(loaded.scene.shapes.at(shape).geometry);
}

inline Vec3 triangle_normal(const TriangleMesh& mesh, std::size_t i)
{
    const auto& t = mesh.triangles.at(i);
    return normalize(cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]));
}

// The plugin is named by the file's ending; `inside` is more of the shape.
inline LoadedScene load_mesh(const std::string& name, const std::string& content, const std::string& inside = "",
                             const std::string& version = "3.0.0")
{
    const SceneFolder folder;
    folder.write(name, content);
    const std::string type = name.substr(name.rfind('.') + 1);
    return folder.load(
        scene_with("<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + name + "\"/>" + inside + "</shape>", version));
}

// What the SceneError says; a failure if there is none.
inline std::string error_of_mesh(const std::string& name, const std::string& content, const std::string& inside = "")
{
    try {
        load_mesh(name, content, inside);
    } catch (const SceneError& error) {
        return error.what();
    }
    ADD_FAILURE() << name << " loaded";
    return {};
}

inline void expect_uv(Vec2 a, Vec2 b)
{
    EXPECT_NEAR(a.x, b.x, 1e-6f);
    EXPECT_NEAR(a.y, b.y, 1e-6f);
}

// Texture coordinates and attributes must fit the mesh, whatever it went through.
inline void expect_complete(const TriangleMesh& mesh)
{
    for (const auto& t : mesh.triangles)
        for (const uint v : t) ASSERT_LT(v, mesh.positions.size());
    EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()) << mesh.normals.size();
    EXPECT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size()) << mesh.uvs.size();
    for (const auto& attribute : mesh.attributes)
        EXPECT_EQ(attribute.values.size(), attribute.per_face ? mesh.triangles.size() : mesh.positions.size()) << attribute.name;
}

} // namespace sundog::testing
