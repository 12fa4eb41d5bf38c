// PLY files of any content give a mesh or a SceneError.
#include "import/ply.h"
#include "mesh_steps.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace sundog;
    try {
        const std::string_view content(reinterpret_cast<const char*>(data), size);
        fuzz::take_all_steps(std::move(parse_ply("fuzz.ply", content, {}).mesh));
    } catch (const SceneError&) {
    }
    return 0;
}
