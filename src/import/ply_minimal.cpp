#include "import/ply.h"

namespace sundog
{

TriangleMesh load_ply(const std::filesystem::path& file, const SourceLocation& wanted_at)
{
    throw SceneError(wanted_at, "'" + file.string() +
                                    "': this build of Sundog reads no PLY; convert the mesh to OBJ, or build without SUNDOG_MINIMAL");
}

} // namespace sundog
