#include "client/cli/table.h"

#include <gtest/gtest.h>

namespace truepose::cli {
namespace {

// Would catch wrong alignment, ragged columns and blanks at line ends.
TEST(Table, AlignsColumnsAndEndsLinesWithoutBlanks) {
  Table table({{"name", Align::kLeft}, {"mm"}, {"note", Align::kLeft}});
  table.Add({"da1", "0.5", "long note"});
  table.Add({"dalpha10", "12.25"});
  EXPECT_EQ(table.Text("> "),
            "> name         mm  note\n"
            "> da1         0.5  long note\n"
            "> dalpha10  12.25\n");
}

// Would catch counting bytes where a terminal shows characters.
TEST(Table, CountsCharactersNotBytes) {
  Table table({{"a", Align::kLeft}, {"b"}});
  table.Add({"µm", "1"});
  table.Add({"mmm", "2"});
  EXPECT_EQ(table.Text(), "a    b\nµm   1\nmmm  2\n");
  EXPECT_EQ(DisplayWidth("▏█"), 2u);
}

// Would catch a "-0.000", which reads as if something were there.
TEST(Fixed, HasNoNegativeZero) {
  EXPECT_EQ(Fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(Fixed(-0.0, 1), "0.0");
  EXPECT_EQ(Fixed(-0.0006, 3), "-0.001");
  EXPECT_EQ(Fixed(1234.5, 0), "1234");
}

TEST(Count, KnowsOneFromMany) {
  EXPECT_EQ(Count(1, "row"), "1 row");
  EXPECT_EQ(Count(0, "row"), "0 rows");
}

}  // namespace
}  // namespace truepose::cli
