#include "formats/wording.h"

#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

// Catches: a long cell that floods the answer, or one cut inside a character (no longer UTF-8).
TEST(WordingTest, QuotesAndCutsBetweenCharacters) {
  EXPECT_EQ(Quoted("a"), "'a'");
  EXPECT_EQ(Quoted(std::string(39, 'x') + "\xC3\xBC" + "y"), "'" + std::string(39, 'x') + "...'");
}

TEST(WordingTest, ListsChoices) {
  EXPECT_EQ(AnyOf({"a"}), "a");
  EXPECT_EQ(AnyOf({"a", "b", "c"}), "a, b or c");
}

// Catches: no suggestion for a slip, a suggestion for a word that means something else.
TEST(WordingTest, FindsTheWordThatWasMeant) {
  EXPECT_EQ(Nearest("geometri", {"joints", "geometry"}), "geometry");
  EXPECT_EQ(Nearest("JOINT", {"joints", "geometry"}), "joints");
  EXPECT_EQ(Nearest("payload", {"joints", "geometry"}), "");
  EXPECT_EQ(Nearest("ab", {"xy"}), "");
}

// Catches: quadratic work on a key as long as the file.
TEST(WordingTest, HasNoSuggestionForAVeryLongWord) {
  EXPECT_EQ(Nearest(std::string(1000000, 'a'), {"joints"}), "");
}

}  // namespace
}  // namespace truepose::formats
