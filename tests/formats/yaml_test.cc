#include "formats/yaml.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

std::vector<std::string> FaultsIn(std::string_view text) {
  FaultList faults;
  ParseYaml(text, "r.yaml", faults);
  std::vector<std::string> lines;
  for (const Fault& fault : faults.faults()) lines.push_back(ToString(fault));
  return lines;
}

YamlNode Parse(std::string_view text) {
  FaultList faults;
  YamlNode root = ParseYaml(text, "r.yaml", faults);
  EXPECT_TRUE(faults.empty()) << faults.ToStatus();
  return root;
}

// Catches: keys and values that get out of step in nested maps and lists, wrong lines.
TEST(YamlTest, BuildsATreeWithLines) {
  const YamlNode root = Parse("# note\na: 1\nb:\n  - {c: x, d: [2, 3]}\n  -\ne: ~\n");
  ASSERT_EQ(root.kind, YamlNode::Kind::kMap);
  ASSERT_THAT(root.items, SizeIs(3));
  EXPECT_EQ(root.items[0].key, "a");
  EXPECT_EQ(root.items[0].text, "1");
  EXPECT_EQ(root.items[0].line, 2);
  const YamlNode& list = root.items[1];
  EXPECT_EQ(list.kind, YamlNode::Kind::kSequence);
  EXPECT_EQ(list.line, 3);
  ASSERT_THAT(list.items, SizeIs(2));
  EXPECT_EQ(list.items[0].line, 4);
  ASSERT_THAT(list.items[0].items, SizeIs(2));
  EXPECT_EQ(list.items[0].items[1].key, "d");
  ASSERT_THAT(list.items[0].items[1].items, SizeIs(2));
  EXPECT_EQ(list.items[0].items[1].items[1].text, "3");
  EXPECT_EQ(list.items[1].kind, YamlNode::Kind::kNull);
  EXPECT_EQ(root.items[2].kind, YamlNode::Kind::kNull);
}

// Catches: the first or the second of two equal keys that disappears before anyone can object.
TEST(YamlTest, KeepsKeysThatStandTwice) { EXPECT_THAT(Parse("a: 1\na: 2\n").items, SizeIs(2)); }

// Catches: a quote that is never closed and swallows the keys behind it in silence.
TEST(YamlTest, NamesTheLineOfASyntaxFault) {
  EXPECT_THAT(FaultsIn("a: 1\nb: [1, 2\nc: 3\n"), SizeIs(1));
  EXPECT_THAT(FaultsIn("a: 1\nb: c: d\n"),
              ElementsAre("r.yaml:2: found illegal map value, expected YAML"));
  EXPECT_THAT(FaultsIn("a:\n\t- 1\n"), SizeIs(1));
  for (const char* text : {"a: 1\nb: 'x\n", "a: 1\nb: \"x\n\n"}) {
    EXPECT_THAT(FaultsIn(text),
                ElementsAre("r.yaml:2: found illegal EOF in scalar, expected YAML"));
  }
}

// Catches: a small file of aliases that unfolds into a huge tree.
TEST(YamlTest, NamesWhatIsNotInTheSubset) {
  EXPECT_THAT(FaultsIn("a: &x 1\nb: *x\n"),
              ElementsAre("r.yaml:2: found an alias (*), expected the value itself"));
  EXPECT_THAT(FaultsIn("a: 1\n---\nb: 2\n"),
              ElementsAre("r.yaml:3: found a second document, expected one document"));
  EXPECT_THAT(FaultsIn("? [1, 2]\n: 3\n"),
              ElementsAre("r.yaml:1: found a list of 2 as a key, expected a word"));
  EXPECT_THAT(FaultsIn("a: L\xF6sung\n"),
              ElementsAre("r.yaml:1: found bytes of another encoding, expected UTF-8 text"));
}

// Catches: a stack overflow by nesting.
TEST(YamlTest, SurvivesDeepNesting) {
  EXPECT_THAT(FaultsIn(std::string(100000, '[')), SizeIs(1));
  EXPECT_THAT(FaultsIn(std::string(100000, '{')), SizeIs(1));
}

TEST(YamlTest, ReadsAByteOrderMark) {
  EXPECT_THAT(Parse("\xEF\xBB\xBF"
                    "a: 1\n")
                  .items,
              SizeIs(1));
  EXPECT_EQ(Parse("").kind, YamlNode::Kind::kNull);
}

// Catches: a text that YAML takes for a comment, a null, a key or a fold.
TEST(YamlTest, WrittenTextsReadBack) {
  for (const std::string text : {"word",
                                 "2016300123",
                                 "null",
                                 "~",
                                 "",
                                 " blanks ",
                                 "a: b",
                                 "#x",
                                 "it's \"so\"",
                                 "back\\slash",
                                 "two\nlines\r\n",
                                 "tab\t",
                                 "\x01\x7F",
                                 "-",
                                 "? x",
                                 "{a}",
                                 "\xC3\xBC\xE2\x82\xAC",
                                 "no",
                                 "&x",
                                 "*x",
                                 "!t",
                                 "%",
                                 "@",
                                 "`"}) {
    const YamlNode root = Parse(YamlText(text) + ": " + YamlText(text) + "\n");
    ASSERT_THAT(root.items, SizeIs(1)) << text;
    EXPECT_EQ(root.items[0].key, text);
    EXPECT_EQ(root.items[0].text, text);
    EXPECT_EQ(root.items[0].kind, YamlNode::Kind::kScalar);
  }
}

}  // namespace
}  // namespace truepose::formats
