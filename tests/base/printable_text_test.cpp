#include "lapwing/base/printable_text.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

TEST(PrintableText, IsLeftAsItIs) {
  for (const char* const text : {"", "a mesh.obj:3: expected x", "Möwe, λ, 鳥, 🐦", "back\\slash"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(PrintableText, HasNoControlsNoEscapesAndNoEndsOfLines) {
  EXPECT_EQ(printable("\x1B[31mred\x07"), "\\x1B[31mred\\x07");
  EXPECT_EQ(printable("a\nb\r\tc\x7F"), "a\\x0Ab\\x0D\\x09c\\x7F");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\u009B31m"), "\\x9B31m") << "the one-character form of an escape";
  EXPECT_EQ(printable("a\u2028b"), "a\\u2028b");
}

TEST(PrintableText, DoesNotTurnTheDirectionOfWriting) {
  EXPECT_EQ(printable("mesh\u202Ejbo.exe"), "mesh\\u202Ejbo.exe");
  EXPECT_EQ(printable("\u2066a\u2069"), "\\u2066a\\u2069");
}

TEST(PrintableText, SpellsOutWhatIsNotUtf8) {
  EXPECT_EQ(printable("M\xF6we"), "M\\xF6we") << "Latin-1";
  EXPECT_EQ(printable("cut \xE9\xB3"), "cut \\xE9\\xB3");
  EXPECT_EQ(printable("\xC0\xAF"), "\\xC0\\xAF") << "longer than needed";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "a surrogate";
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80") << "beyond Unicode";
  EXPECT_EQ(printable("\xFF"), "\\xFF");
}

TEST(PrintableText, OfPrintableTextIsTheSame) {
  const std::string once = printable("\x1B\n\xF6 and more");
  EXPECT_EQ(printable(once), once);
}

TEST(PrintableText, KeepsBeginningAndEndOfWhatIsTooLong) {
  const std::string text = "place: " + std::string(5000, 'x') + "; next step";
  const std::string shown = printable(text, 100);
  EXPECT_LE(shown.size(), 100U);
  EXPECT_TRUE(shown.starts_with("place: xxx"));
  EXPECT_TRUE(shown.ends_with("xxx; next step"));
  EXPECT_NE(shown.find(" ... "), std::string::npos);
}

TEST(PrintableText, IsNotCutWithinACharacter) {
  std::string birds;
  for (int k = 0; k < 100; ++k) birds += "鳥";
  for (std::size_t longest = 20; longest < 30; ++longest) {
    const std::string shown = printable(birds, longest);
    EXPECT_LE(shown.size(), longest);
    EXPECT_EQ(printable(shown), shown) << "still UTF-8";
  }
}

TEST(PrintableText, ListsAtMostFiveNames) {
  const std::vector<std::string> names{"a", "b", "c", "d", "e", "f"};
  const std::span<const std::string> all(names);
  EXPECT_EQ(quoted_list(all.first(1)), "'a'");
  EXPECT_EQ(quoted_list(all.first(2)), "'a' and 'b'");
  EXPECT_EQ(quoted_list(all.first(5)), "'a', 'b', 'c', 'd' and 'e'");
  EXPECT_EQ(quoted_list(all), "'a', 'b', 'c', 'd' and 2 more");
}

TEST(PrintableText, IsWhatEveryErrorSays) {
  EXPECT_STREQ(InputError("a\x1B]0;title\x07.obj: no vertices").what(),
               "a\\x1B]0;title\\x07.obj: no vertices");
  EXPECT_LE(std::string(IoError(std::string(1'000'000, 'x')).what()).size(), kLongestMessage);
}

}  // namespace
}  // namespace lapwing
