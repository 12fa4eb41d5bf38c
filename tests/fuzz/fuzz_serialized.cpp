// .serialized files of any content give a mesh or a SceneError.
#include "import/serialized.h"
#include "mesh_steps.h"

#include <cstdint>
#include <zlib.h>

namespace
{

// A fuzzer that changes deflated bytes breaks the stream, not what is in it: an input that begins with z is the inflated
// content of a file of version 4.
std::string wrapped(const std::uint8_t* data, std::size_t size)
{
    std::string file("\x1c\x04\x04\x00", 4);
    uLongf length = compressBound(size);
    file.resize(4 + length);
    compress2(reinterpret_cast<Bytef*>(file.data() + 4), &length, data, size, 1);
    file.resize(4 + length);
    return file;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace sundog;
    try {
        const bool inflated = size > 0 && data[0] == 'z';
        const std::string file = inflated ? wrapped(data + 1, size - 1) : std::string(reinterpret_cast<const char*>(data), size);
        // The file's own last byte, by which its count of meshes ends, says which mesh is asked for.
        const int index = file.empty() || inflated ? 0 : static_cast<unsigned char>(file.back()) % 3;
        fuzz::take_all_steps(std::move(parse_serialized("fuzz.serialized", file, {}, index, {0, 0, 0}).mesh));
    } catch (const SceneError&) {
    }
    return 0;
}
