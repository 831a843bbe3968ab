#include "formats/csv.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> Lines(const FaultList& faults) {
  std::vector<std::string> lines;
  for (const Fault& fault : faults.faults()) lines.push_back(ToString(fault));
  return lines;
}

CsvTable Parse(std::string_view text) {
  FaultList faults;
  CsvTable table = ParseCsv(text, "t.csv", faults);
  EXPECT_THAT(Lines(faults), IsEmpty());
  return table;
}

std::vector<std::string> FaultsIn(std::string_view text) {
  FaultList faults;
  ParseCsv(text, "t.csv", faults);
  return Lines(faults);
}

// Catches: a lost header, cells in the wrong order, a last line without an end that is dropped.
TEST(CsvTest, ReadsHeaderAndRows) {
  const CsvTable table = Parse("a,b\n1,2\n3,4");
  EXPECT_THAT(table.header.cells, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2);
  EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "4"));
  EXPECT_FALSE(table.decimal_comma);
}

// Catches: a byte order mark that becomes part of the first name, carriage returns that stay in the
// last cell.
TEST(CsvTest, ReadsByteOrderMarkAndCarriageReturns) {
  const CsvTable table = Parse(
      "\xEF\xBB\xBF"
      "a,b\r\n1,2\r\n");
  EXPECT_THAT(table.header.cells, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 1);
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1", "2"));
}

// Catches: a decimal comma taken as a separator.
TEST(CsvTest, SemicolonInTheHeaderMakesCommasDecimal) {
  const CsvTable table = Parse("\r\na;b\n1,5;2,5\n");
  EXPECT_TRUE(table.decimal_comma);
  ASSERT_EQ(table.rows.size(), 1);
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1,5", "2,5"));
}

// Catches: a semicolon inside quotes that changes the separator.
TEST(CsvTest, SemicolonInQuotesIsText) {
  EXPECT_THAT(Parse("\"a;b\",c\n1,2\n").header.cells, ElementsAre("a;b", "c"));
}

// Catches: quotes left in cells, separators and line ends inside quotes that split a cell, blanks
// dropped there.
TEST(CsvTest, ReadsQuotedCells) {
  const CsvTable table = Parse("a,b,c\n\" x,y \" ,\"say \"\"so\"\"\",\"two\nlines\"\n");
  ASSERT_EQ(table.rows.size(), 1);
  EXPECT_THAT(table.rows[0].cells, ElementsAre(" x,y ", "say \"so\"", "two\nlines"));
}

// Catches: lines counted without blank lines or without line ends in quotes, so that faults name
// the wrong line.
TEST(CsvTest, RowsKnowTheirLines) {
  const CsvTable table = Parse("\na,b\n\n\"1\n1\",2\n , \n3,4\n");
  EXPECT_EQ(table.header.line, 2);
  ASSERT_EQ(table.rows.size(), 2);
  EXPECT_EQ(table.rows[0].line, 4);
  EXPECT_EQ(table.rows[1].line, 7);
}

// Catches: views into a table that was moved from.
TEST(CsvTest, CellsOutliveAMoveOfTheTable) {
  CsvTable table = Parse("a\n\"\"\"q\"\"\"\n");
  const CsvTable moved = std::move(table);
  EXPECT_THAT(moved.rows[0].cells, ElementsAre("\"q\""));
}

// Catches: a ragged row that is padded or cut, or that hides the next one.
TEST(CsvTest, NamesEveryRaggedRow) {
  EXPECT_THAT(FaultsIn("a,b\n1\n1,2\n1,2,3\n"),
              ElementsAre("t.csv:2: found 1 cells, expected 2 as in the header",
                          "t.csv:4: found 3 cells, expected 2 as in the header"));
}

// Catches: an open quote that swallows the rest of the file in silence.
TEST(CsvTest, NamesAnOpenQuoteAtItsFirstLine) {
  EXPECT_THAT(FaultsIn("a\n\"1\n2\n3"),
              ElementsAre("t.csv:2: found a quote that is never closed, expected a closing quote"));
}

TEST(CsvTest, NamesTextAfterAClosingQuote) {
  EXPECT_THAT(FaultsIn("a\n\"1\"2\n"),
              ElementsAre("t.csv:2: found '2' after a closing quote, expected a separator"));
}

// Catches: bytes that a message can't hold (Latin-1, UTF-16, NUL).
TEST(CsvTest, NamesAnotherEncoding) {
  const auto fault = [](int line) {
    return "t.csv:" + std::to_string(line) +
           ": found bytes of another encoding, expected UTF-8 text";
  };
  EXPECT_THAT(FaultsIn("a\nL\xF6sung\n"), ElementsAre(fault(2)));
  EXPECT_THAT(FaultsIn("\xFF\xFE"
                       "a\n"),
              ElementsAre(fault(1)));
  EXPECT_THAT(FaultsIn(std::string_view("a\n1\n\0\n", 6)), ElementsAre(fault(3)));
}

TEST(CsvTest, NamesAMissingHeader) {
  const auto fault = ElementsAre("t.csv: found no text, expected a header line");
  EXPECT_THAT(FaultsIn(""), fault);
  EXPECT_THAT(FaultsIn("\xEF\xBB\xBF\r\n , \n"), fault);
}

// Catches: a cell that reads back as another one.
TEST(CsvTest, WritesCellsThatReadBack) {
  const std::vector<std::string> cells = {
      "plain", "a,b",  "x;y", "say \"so\"", " blanks ", "two\nlines", "\xEF\xBB\xBFmark",
      "",      "tab\t"};
  const std::string text = "1,2,3,4,5,6,7,8,9\n" + CsvLine(cells);
  const CsvTable table = Parse(text);
  ASSERT_EQ(table.rows.size(), 1);
  EXPECT_EQ(std::vector<std::string>(table.rows[0].cells.begin(), table.rows[0].cells.end()),
            cells);
}

}  // namespace
}  // namespace truepose::formats
