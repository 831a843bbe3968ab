#include "core/reproduce/table3.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace truepose {
namespace {

using ::testing::UnorderedElementsAreArray;

// The names that are found are those printed, the last two lines of the table included. Would catch
// a preference that keeps another partner, motions of base or gripper at the wrong point, and a
// name of the table copied wrongly (28 each).
TEST(Table3, FindsWhatTheChapterPrints) {
  const auto columns = Table3();
  ASSERT_TRUE(columns.ok()) << columns.status();
  ASSERT_EQ(columns->size(), 4u);
  for (const Table3Column& column : *columns) {
    SCOPED_TRACE(column.model);
    EXPECT_EQ(column.names.size(), 28u);
    EXPECT_EQ(column.base.size(), 6u);
    EXPECT_EQ(column.gripper.size(), 6u);
    EXPECT_EQ(column.internal, 16);
    if (column.model == "zhuang_roth") continue;  // not in the table
    EXPECT_THAT(column.names, UnorderedElementsAreArray(column.printed_names));
    EXPECT_THAT(column.base, UnorderedElementsAreArray(column.printed_base));
    EXPECT_THAT(column.gripper, UnorderedElementsAreArray(column.printed_gripper));
  }
}

// h_2 = h_3 and l_3 = h_4, the two in parentheses in the table.
TEST(Table3, ExtendedDhHasItsTwoRedundancies) {
  const auto columns = Table3();
  ASSERT_TRUE(columns.ok()) << columns.status();
  EXPECT_EQ(columns->front().redundant, (std::vector<std::string>{"dh3 = +1 dh2", "dh4 = +1 dq3"}));
}

}  // namespace
}  // namespace truepose
