#include "programs/diff.h"

#include <gtest/gtest.h>

#include "programs/lines.h"

namespace truepose::programs {
namespace {

// Would catch hunks that `patch` refuses: wrong counts, wrong order, missing context.
TEST(DiffTest, IsUnified) {
  EXPECT_EQ(
      UnifiedDiff("1\n2\n3\n4\n5\nsix\nseven\n8\n9\n10\n11\n",
                  "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n", "a.src", "b.src"),
      "--- a.src\n+++ b.src\n@@ -3,8 +3,8 @@\n 3\n 4\n 5\n-six\n-seven\n+6\n+7\n 8\n 9\n 10\n");
}

TEST(DiffTest, NearHunksAreOneFarOnesAreTwo) {
  const auto hunks = [](std::string before, std::string after) {
    const std::string diff = UnifiedDiff(before, after, "a", "b");
    int count = 0;
    for (size_t at = 0; (at = diff.find("@@ -", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(hunks("x\n1\n2\n3\n4\n5\n6\nx\n", "y\n1\n2\n3\n4\n5\n6\ny\n"), 1);
  EXPECT_EQ(hunks("x\n1\n2\n3\n4\n5\n6\n7\nx\n", "y\n1\n2\n3\n4\n5\n6\n7\ny\n"), 2);
}

// Would catch a last line without an end that patch would give one, and CR that is lost.
TEST(DiffTest, LineEndsAreKept) {
  EXPECT_EQ(
      UnifiedDiff("a\r\nb", "a\r\nc", "x", "y"),
      "--- x\n+++ y\n@@ -1,2 +1,2 @@\n a\r\n-b\n\\ No newline at end of file\n+c\n\\ No newline "
      "at end of file\n");
}

TEST(DiffTest, EqualTextsHaveNone) { EXPECT_EQ(UnifiedDiff("a\n", "a\n", "x", "y"), ""); }

TEST(LinesTest, LinesOfAreTheText) {
  const auto lines = LinesOf("a\r\n\nb\rc");
  EXPECT_EQ(lines, (std::vector<std::string_view>{"a\r\n", "\n", "b\r", "c"}));
  EXPECT_TRUE(LinesOf("").empty());
}

TEST(LinesTest, ExcerptsAreShortAndWholeCharacters) {
  EXPECT_EQ(Excerpt("  a b \r\n"), "a b");
  EXPECT_EQ(Excerpt(" \r\n"), "");
  const std::string cut = Excerpt(std::string(71, 'x') + "\xC3\xBC" + "y");
  EXPECT_EQ(cut, std::string(71, 'x') + "...");
}

TEST(LinesTest, NumbersInRanges) {
  EXPECT_EQ(LineNumbers({7, 3, 8, 9, 9, 12, 13}), "3, 7-9, 12, 13");
  EXPECT_EQ(LineNumbers({}), "");
}

}  // namespace
}  // namespace truepose::programs
