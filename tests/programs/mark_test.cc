// The line by which a corrected program says that it is one.
#include "programs/mark.h"

#include <gtest/gtest.h>

#include "programs/correct.h"
#include "programs/diff.h"
#include "programs/lines.h"
#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

constexpr char kDigest[] = "0123456789abcdef";

MarkedText Marked(std::string_view text, Dialect dialect) {
  const auto marked = AddMark(text, dialect, 6, kDigest);
  EXPECT_TRUE(marked.ok()) << marked.status();
  return marked.value_or(MarkedText{});
}

std::string Line(char sign, std::string_view end = "\n") {
  return std::string(1, sign) + " corrected by truepose, calibration " + kDigest +
         ": correct the original, not this file" + std::string(end);
}

// Would catch a line where the controller allows none: above KRL's attributes and RAPID's module.
TEST(MarkTest, StandsWhereTheLanguageHasComments) {
  EXPECT_EQ(Marked("def f():\nend\n", Dialect::kUrScript).text, Line('#') + "def f():\nend\n");
  EXPECT_EQ(Marked("&ACCESS RVP\r\n&REL 1\r\nDEF f( )\r\n", Dialect::kKrl).text,
            "&ACCESS RVP\r\n&REL 1\r\n" + Line(';', "\r\n") + "DEF f( )\r\n");
  EXPECT_EQ(Marked("DEFDAT f\n", Dialect::kKrl).text, Line(';') + "DEFDAT f\n");
  const std::string head = "%%%\n  VERSION:1\n%%%\n";
  EXPECT_EQ(Marked(head + " module A(SYSMODULE)\nENDMODULE\n", Dialect::kRapid).text,
            head + " module A(SYSMODULE)\n" + Line('!') + "ENDMODULE\n");
  EXPECT_EQ(Marked(head + "PROC p()\n", Dialect::kRapid).text, head + Line('!') + "PROC p()\n");
  EXPECT_EQ(Marked("PROC p()\n", Dialect::kRapid).text, Line('!') + "PROC p()\n");
}

// Would catch a byte order mark in the middle of the file, and two lines that become one.
TEST(MarkTest, KeepsTheBytesAroundIt) {
  EXPECT_EQ(Marked("\xEF\xBB\xBF"
                   "def f():\n",
                   Dialect::kUrScript)
                .text,
            "\xEF\xBB\xBF"
            "def f():\n" +
                Line('#'));
  EXPECT_EQ(Marked("MODULE A", Dialect::kRapid).text, "MODULE A\n" + Line('!'));
  EXPECT_EQ(Marked("a\rb\r", Dialect::kUrScript).text, Line('#', "\r") + "a\rb\r");
}

// Would catch a mark that the next run doesn't see, whatever an editor made of its blanks, and a
// program that is taken for corrected because it speaks of it.
TEST(MarkTest, IsFoundAgain) {
  for (const Dialect dialect : {Dialect::kUrScript, Dialect::kKrl, Dialect::kRapid}) {
    const auto mark = FindMark(Marked("a\nb\n", dialect).text, dialect);
    ASSERT_TRUE(mark.has_value());
    EXPECT_EQ(mark->line, 1);
    EXPECT_EQ(mark->calibration, kDigest);
  }
  EXPECT_EQ(FindMark("x\n  #corrected by truepose, calibration ab\r\n", Dialect::kUrScript)->line,
            2);
  EXPECT_FALSE(
      FindMark("textmsg(\"# corrected by truepose, calibration ab\")\n", Dialect::kUrScript)
          .has_value());
  EXPECT_FALSE(FindMark("# to be corrected by truepose\n", Dialect::kUrScript).has_value());
  EXPECT_FALSE(FindMark("", Dialect::kKrl).has_value());
}

// Would catch a mark that changes what the rest of a whole program means.
TEST(MarkTest, WholeProgramsStayWhatTheyAre) {
  for (const char* name : {"palletize.script", "weld.src", "weld.dat", "polish.mod"}) {
    const std::string text = Golden(name);
    CorrectOptions options;
    options.calibration = kDigest;
    const auto plain = CorrectProgram(text, name, *DialectOfFile(name), kSixRevolute, Shifted, {});
    const auto marked =
        CorrectProgram(text, name, *DialectOfFile(name), kSixRevolute, Shifted, options);
    ASSERT_TRUE(marked.ok()) << marked.status();
    EXPECT_EQ(FindMark(marked->text, *DialectOfFile(name))->line, marked->mark_line) << name;
    std::string without;
    int line = 0;
    for (const std::string_view one : LinesOf(marked->text))
      if (++line != marked->mark_line) without += one;
    EXPECT_EQ(without, plain->text) << name;
    EXPECT_EQ(marked->passed_through, plain->passed_through) << "lines of the input";
  }
}

// Would catch a mark on a copy in which nothing was corrected.
TEST(MarkTest, ACopyHasNone) {
  CorrectOptions options;
  options.calibration = kDigest;
  const auto copy = CorrectProgram("movel(p[0,0,0,0,0,0])\n", "a.script", Dialect::kUrScript,
                                   kSixRevolute, Shifted, options);
  ASSERT_TRUE(copy.ok()) << copy.status();
  EXPECT_EQ(copy->mark_line, 0);
  EXPECT_EQ(copy->text, "movel(p[0,0,0,0,0,0])\n");
}

// Would catch hunks of which `patch` makes another file: lines below the mark are one further down.
TEST(MarkTest, TheDiffHasItAsANewLine) {
  EXPECT_EQ(UnifiedDiff("1\n2\n3\n4\n5\n", "m\n1\n2\n3\n4\n5\n", "a", "b", 1),
            "--- a\n+++ b\n@@ -1,3 +1,4 @@\n+m\n 1\n 2\n 3\n");
  EXPECT_EQ(UnifiedDiff("1\n2\n3\n4\n5\n6\n7\n8\n9\nx\n", "1\nm\n2\n3\n4\n5\n6\n7\n8\n9\ny\n", "a",
                        "b", 2),
            "--- a\n+++ b\n@@ -1,4 +1,5 @@\n 1\n+m\n 2\n 3\n 4\n"
            "@@ -7,4 +8,4 @@\n 7\n 8\n 9\n-x\n+y\n");
  EXPECT_EQ(UnifiedDiff("MODULE A", "MODULE A\nm\n", "a", "b", 2),
            "--- a\n+++ b\n@@ -1,1 +1,2 @@\n-MODULE A\n\\ No newline at end of file\n"
            "+MODULE A\n+m\n");
}

}  // namespace
}  // namespace truepose::programs
