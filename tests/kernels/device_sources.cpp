// One program text from many files.
#include "device/flatten.h"
#include "device/kernel_sources.h"
#include "support/places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace sundog
{
namespace
{

using testing::HasSubstr;

std::string flatten(const std::map<std::string, std::string, std::less<>>& files, const BuildOptions& options = {})
{
    const auto lookup = [&](std::string_view path) {
        const auto found = files.find(path);
        return found == files.end() ? std::string_view() : std::string_view(found->second);
    };
    return flatten_source("stages/s.cl", files.at("stages/s.cl"), options, lookup);
}

std::size_t occurrences(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(DeviceSources, EmbedsEveryFileUnchanged)
{
    const auto names = kernel_source_names();
    EXPECT_TRUE(std::find(names.begin(), names.end(), "shared/vec3.h") != names.end());
    for (const auto name : names) {
        std::ifstream file(test::source_folder() / "kernels" / name);
        std::stringstream text;
        text << file.rdbuf();
        EXPECT_EQ(kernel_source(name), text.str()) << name;
    }
    EXPECT_TRUE(kernel_source("shared/no_such_file.h").empty());
}

TEST(DeviceSources, ExpandsIncludesOnceAndKeepsLineNumbers)
{
    const auto text = flatten({{"stages/s.cl", "int before;\n#include \"a.h\"\n  #  include \"b.h\" // note\nint after;\n"},
                               {"a.h", "#include \"b.h\"\nint a;\n"},
                               {"b.h", "int b;\n"}});
    EXPECT_EQ(text, "#line 1 \"stages/s.cl\"\nint before;\n"
                    "#line 1 \"a.h\"\n#line 1 \"b.h\"\nint b;\n#line 2 \"a.h\"\nint a;\n#line 3 \"stages/s.cl\"\n"
                    "#line 4 \"stages/s.cl\"\nint after;\n");
}

TEST(DeviceSources, PutsDefinesAndPreludeFirst)
{
    const auto text = flatten({{"stages/s.cl", "#include \"e.h\"\nint s;\n"}, {"e.h", "int e;\n"}},
                              {.defines = {{"MATERIALS", "3"}, {"MEDIA", ""}}, .prelude = {"e.h"}});
    EXPECT_THAT(text, testing::StartsWith("#define MATERIALS 3\n#define MEDIA \n#line 1 \"e.h\"\nint e;\n"));
    EXPECT_EQ(occurrences(text, "int e;"), 1u);
}

// An include that the compiler may skip must not hide a later one that it needs.
TEST(DeviceSources, RepeatsWhatWasIncludedUnderACondition)
{
    const std::string guarded = "#ifndef B_H\n#define B_H\n#include \"c.h\"\nint b;\n#endif\n";
    const auto text = flatten({{"stages/s.cl", "#ifdef NEVER\n#include \"b.h\"\n#endif\n#include \"b.h\"\n#include \"b.h\"\n"},
                               {"b.h", guarded},
                               {"c.h", "int c;\n"}});
    EXPECT_EQ(occurrences(text, "int b;"), 2u);
    EXPECT_EQ(occurrences(text, "int c;"), 2u);
    EXPECT_LT(text.rfind("#endif", text.rfind("int b;")), text.rfind("int c;"));
}

TEST(DeviceSources, EndsCycles)
{
    const auto text = flatten({{"stages/s.cl", "#if X\n#include \"a.h\"\n#endif\n"},
                               {"a.h", "#include \"b.h\"\nint a;\n"},
                               {"b.h", "#include \"a.h\"\nint b;\n"}});
    EXPECT_EQ(occurrences(text, "int a;"), 1u);
}

TEST(DeviceSources, NamesFileAndLineOfAMissingInclude)
{
    try {
        flatten({{"stages/s.cl", "\n\n#include \"gone.h\"\n"}});
        FAIL() << "no error";
    } catch (const std::logic_error& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("stages/s.cl:3"), HasSubstr("gone.h")));
    }
}

} // namespace
} // namespace sundog
