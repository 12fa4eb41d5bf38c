// tests/scenes holds scenes as tests and tutorials of other renderers of the dialect have them. Each loads, with the
// warnings that its comment names.
#include "support/places.h"
#include "unit/scene_folder.h"

#include <sstream>

namespace
{

using namespace sundog;

// What follows "warns: " on the lines of a file; characters of 16 bits count by their lower byte.
std::vector<std::string> expected_warnings(const std::filesystem::path& file)
{
    std::ostringstream content;
    content << std::ifstream(file, std::ios::binary).rdbuf();
    std::string text = content.str();
    std::erase(text, '\0');
    std::istringstream lines(text);
    std::vector<std::string> expected;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("warns: ")) expected.push_back(line.substr(7));
    return expected;
}

TEST(ImportOutsideScenes, LoadWithTheWarningsTheyName)
{
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() / "tests/scenes")) {
        if (entry.path().extension() != ".xml") continue;
        SCOPED_TRACE(entry.path().filename());
        count++;
        const LoadedScene loaded = load_scene(entry.path(), {});
        EXPECT_FALSE(loaded.scene.integrator.method.empty());
        std::vector<std::string> expected = expected_warnings(entry.path());
        for (const Warning& warning : loaded.warnings) {
            const auto named = std::find_if(expected.begin(), expected.end(),
                                            [&](const std::string& text) { return warning.text.find(text) != std::string::npos; });
            if (named == expected.end())
                ADD_FAILURE() << "not named in the scene: " << warning;
            else
                expected.erase(named);
        }
        for (const std::string& text : expected) ADD_FAILURE() << "did not warn: " << text;
    }
    EXPECT_GE(count, 20);
}

} // namespace
