// What the importer does with a mesh after it is read.
#pragma once

#include "import/mesh_cleanup.h"
#include "import/mesh_normals.h"

namespace sundog::fuzz
{

// Throws SceneError as the steps do.
inline void take_all_steps(TriangleMesh mesh)
{
    const SourceLocation nowhere;
    require_valid_indices(mesh, nowhere, "mesh");
    require_finite_vertices(mesh, nowhere, "mesh");
    transform_mesh(mesh, Transform::scale({-1, 2, 3}), false);
    require_finite_vertices(mesh, nowhere, "mesh");
    std::vector<int> none;
    drop_degenerate_triangles(mesh, none);
    if (mesh.triangles.empty()) return;
    turn_opposed_faces(mesh);
    TriangleMesh creased = mesh;
    smooth_up_to(creased, 0.5);
    complete_normals(mesh);
}

} // namespace sundog::fuzz
