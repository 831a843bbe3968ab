#include "programs/token.h"

#include <gtest/gtest.h>

#include "programs/words.h"

namespace truepose::programs {
namespace {

// "n:a s:=" and so on, one letter for the kind.
std::string Cut(std::string_view text, const Lexis& lexis) {
  const Words words(text, lexis);
  std::string result;
  for (size_t i = 0; !words.IsEnd(i); ++i) {
    result += std::string(1, "n0tsL?E"[static_cast<int>(words.At(i).kind)]) + ":";
    if (!words.Is(i, TokenKind::kLineEnd)) result += words.Text(i);
    result += " ";
  }
  return result;
}

constexpr Lexis kHash{.comment = '#', .backslash_unclear = true};

TEST(TokenTest, CutsNamesNumbersAndSigns) {
  EXPECT_EQ(Cut("q_1:=[-1.5,2e-3,.5]", kHash), "n:q_1 s::= s:[ s:- 0:1.5 s:, 0:2e-3 s:, 0:.5 s:] ");
  EXPECT_EQ(Cut("a==b != c", kHash), "n:a s:== n:b s:!= n:c ");
}

// Would catch 0x1F or 1.2.3 taken for the number that it begins with.
TEST(TokenTest, WhatOnlyBeginsLikeANumberIsUnclear) {
  EXPECT_EQ(Cut("0x1F 12ab 1.2.3 1e5 1e+ 1..2", kHash),
            "?:0x1F ?:12ab ?:1.2.3 0:1e5 ?:1e s:+ ?:1..2 ");
}

// Would catch a motion in a comment or a text that is taken for one.
TEST(TokenTest, CommentsAndTextsHaveNoWords) {
  EXPECT_EQ(Cut("a # b [1]\nc \"d # e\" f", kHash), "n:a L: n:c t:\"d # e\" n:f ");
  const Lexis rapid{.comment = '!', .doubled_quotes = true};
  EXPECT_EQ(Cut("\"a\"\"! b\" c", rapid), "t:\"a\"\"! b\" n:c ");
  const Lexis krl{.comment = ';', .header = '&'};
  EXPECT_EQ(Cut("&ACCESS a\r\nb & c;d", krl), "L: n:b s:& n:c ");
}

// Would catch a text whose end nobody can tell hiding, or giving away, what follows it.
TEST(TokenTest, TextWithoutAnEndTakesItsLineOnly) {
  EXPECT_EQ(Cut("\"a b\nc", kHash), "?:\"a b L: n:c ");
  EXPECT_EQ(Cut("\"a\\\" b\"\nc", kHash), "?:\"a\\\" b\" L: n:c ");
}

TEST(TokenTest, LinesEndInThreeWays) {
  const auto tokens = Tokenize("a\r\nb\nc\rd", kHash);
  ASSERT_EQ(tokens.size(), 8u);
  EXPECT_EQ(tokens[2].line, 2u);
  EXPECT_EQ(tokens[4].line, 3u);
  EXPECT_EQ(tokens[6].line, 4u);
}

// Would catch a sign lost with what stands between it and its number, and a number that overflows.
TEST(WordsTest, ReadsSignedNumbers) {
  const auto read = [](std::string_view text) {
    size_t i = 0;
    return Words(text, kHash).ReadNumber(&i, Unit::kRadOrM);
  };
  EXPECT_EQ(read("- 1.5")->value, -1.5);
  EXPECT_EQ(read("- 1.5")->end, 5u);
  EXPECT_EQ(read("+2")->value, 2.0);
  for (const char* text : {"-\n1", "--1", "a", "1e999", ""}) EXPECT_FALSE(read(text)) << text;
}

}  // namespace
}  // namespace truepose::programs
