// A folder of scene files that lives as long as the object.
#pragma once

#include "import/mitsuba_xml.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace sundog::testing
{

class SceneFolder
{
public:
    SceneFolder()
    {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() / ("sundog_import_" + std::to_string(getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~SceneFolder() { std::filesystem::remove_all(path_); }
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        const auto file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }

    LoadedScene load(const std::string& xml, const LoadOptions& options = {}) const { return load_scene(write("scene.xml", xml), options); }

private:
    std::filesystem::path path_;
};

// One line of a scene that is complete but for `inside`: a sensor, a lit rectangle.
inline std::string scene_with(const std::string& inside, const std::string& version = "3.0.0")
{
    return "<scene version=\"" + version + "\">\n" + inside +
           "\n<sensor type=\"perspective\"/>"
           "<shape type=\"rectangle\"><emitter type=\"area\"/></shape></scene>\n";
}

inline LoadedScene load_with(const std::string& inside, const LoadOptions& options = {}, const std::string& version = "3.0.0")
{
    return SceneFolder().load(scene_with(inside, version), options);
}

inline void expect_near(Vec3 a, Vec3 b, float tolerance)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

} // namespace sundog::testing
