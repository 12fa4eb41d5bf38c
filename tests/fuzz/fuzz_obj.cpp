// OBJ files of any content give a mesh or a SceneError.
#include "import/obj.h"
#include "mesh_steps.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace sundog;
    try {
        const std::string_view content(reinterpret_cast<const char*>(data), size);
        fuzz::take_all_steps(std::move(parse_obj("fuzz.obj", content, {}).mesh));
    } catch (const SceneError&) {
    }
    return 0;
}
