// Names of any content fit in one line of a message.
#include "base/errors.h"
#include "base/printable.h"
#include "base/warning.h"

#include <gtest/gtest.h>

using namespace sundog;

TEST(Printable, ControlCharactersAreEscaped)
{
    EXPECT_EQ(printable("a\nb\r\tc"), "a\\nb\\r\\tc");
    EXPECT_EQ(printable(std::string_view("\x1b[31m\0\x7f", 7)), "\\x1b[31m\\x00\\x7f");
    EXPECT_EQ(printable("\xc2\x9b" "2J"), "\\x9b2J") << "U+009B begins a command as ESC [ does";
}

TEST(Printable, AllElseIsKept)
{
    for (const char* text : {"", "scene.xml:3: 'caf\xc3\xa9'", "\xc2\xa0\xf0\x9f\x98\x80", "\xc2", "back\\nslash"}) EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable_lines("one\n\ttwo\x1b"), "one\n\ttwo\\x1b");
}

TEST(Printable, MessagesAreOneLine)
{
    EXPECT_STREQ(SceneError({"a\nb.xml", 2}, "no\x1b").what(), "a\\nb.xml:2: no\\x1b");
    EXPECT_STREQ(UsageError("x\ny").what(), "x\\ny");
    EXPECT_STREQ(DeviceError("first\nbuild log").what(), "first\nbuild log");
    EXPECT_EQ(Warning("w\nx").text, "w\\nx");
}
