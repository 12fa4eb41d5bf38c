// Scene files of any content give a scene or an error with its place.
#include "import/mitsuba_xml.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace
{

// A folder with the files that the corpus names.
const std::filesystem::path& folder()
{
    static const std::filesystem::path path = [] {
        const auto made = std::filesystem::temp_directory_path() / ("sundog_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        std::ofstream(made / "m.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
        std::ofstream(made / "t.ppm") << "P3\n2 1\n255\n255 0 16 128 128 128\n";
        std::ofstream(made / "i.xml") << "<emitter type=\"point\"/>";
        return made;
    }();
    return path;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto file = folder() / "scene.xml";
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        sundog::load_scene(file, {});
    } catch (const sundog::Error&) {
    }
    return 0;
}
