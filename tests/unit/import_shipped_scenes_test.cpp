// The scenes that come with Sundog load without a word, and the analytic ones state their answer.
#include "support/places.h"
#include "unit/scene_folder.h"

#include <sstream>

namespace
{

using namespace sundog;

std::vector<std::filesystem::path> scenes_in(const std::string& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() / "scenes" / folder))
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    return files;
}

std::string text_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(ImportShippedScenes, LoadWithoutWarnings)
{
    for (const char* folder : {"gallery", "analytic"}) {
        const auto files = scenes_in(folder);
        EXPECT_GE(files.size(), 4u);
        for (const auto& file : files) {
            const LoadedScene loaded = load_scene(file, {});
            EXPECT_TRUE(loaded.warnings.empty()) << file << ": " << loaded.warnings.front();
            EXPECT_FALSE(loaded.scene.integrator.method.empty()) << file;
            EXPECT_NE(text_of(file).find("<!--"), std::string::npos) << file << " must say what it shows";
        }
    }
}

TEST(ImportShippedScenes, AnalyticOnesHoldAnAnswerAndStayQuick)
{
    for (const auto& file : scenes_in("analytic")) {
        EXPECT_NE(text_of(file).find("\nanswer: "), std::string::npos) << file;
        const Film film = load_scene(file, {}).scene.film;
        EXPECT_LE(film.width * film.height, 32 * 32) << file;
        EXPECT_EQ(film.filter.kind, FilterKind::box) << file << ": the mean of the image is the answer";
    }
}

TEST(ImportShippedScenes, GalleryFilesAreSmall)
{
    for (const char* folder : {"meshes", "textures"})
        for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() / "scenes/gallery" / folder))
            EXPECT_LT(entry.file_size(), 1u << 20) << entry.path();
}

} // namespace
