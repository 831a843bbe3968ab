#include "core/assessment/split.h"

#include <gtest/gtest.h>

#include "core/base/fault.h"

namespace truepose {
namespace {

using Rows = std::vector<int>;
using Strings = std::vector<std::string>;

// Calibration rows of a split of n rows.
Rows Calibration(const std::string& text, int n, const Strings& groups = {},
                 const Strings& values = {}) {
  const auto split = ParseSplit(text);
  EXPECT_TRUE(split.ok()) << split.status();
  const auto roles = ApplySplit(*split, n, groups, values);
  EXPECT_TRUE(roles.ok()) << roles.status();
  Rows rows;
  for (int i = 0; i < n; ++i) {
    if ((*roles)[i]) rows.push_back(i);
  }
  return rows;
}

TEST(Split, Rules) {
  EXPECT_EQ(Calibration("", 3), (Rows{0, 1, 2}));
  EXPECT_EQ(Calibration("even-odd", 5), (Rows{0, 2, 4}));
  EXPECT_EQ(Calibration("first:2", 5), (Rows{0, 1}));
  EXPECT_EQ(Calibration("every:3", 8), (Rows{0, 3, 6}));
  EXPECT_EQ(Calibration("spaced:3", 10), (Rows{0, 4, 9}));  // trunc(i 9 / 2)
  EXPECT_EQ(Calibration("spaced:1", 10), (Rows{0}));
  EXPECT_EQ(Calibration("spaced:4", 4), (Rows{0, 1, 2, 3}));
}

// Known answers of a separate implementation of the shuffle: a split is named in reports and must
// never change.
TEST(Split, RandomIsTheDocumentedShuffle) {
  EXPECT_EQ(Calibration("random:7", 10), (Rows{0, 3, 4, 7, 9}));
  EXPECT_EQ(Calibration("random:1:0.25", 12), (Rows{3, 5, 10}));
}

TEST(Split, ColumnNamesTheControlRows) {
  EXPECT_EQ(Calibration("column:p=b", 4, {}, {"a", "b", "c", "b"}), (Rows{0, 2}));
  EXPECT_EQ(Calibration("column:p==x", 2, {}, {"=x", "x"}), (Rows{1}));
}

// Equal values are never separated; the rule counts groups; empty values stand for themselves.
TEST(Split, GroupsStayTogether) {
  EXPECT_EQ(Calibration("even-odd", 6, {"a", "b", "a", "", "", "b"}), (Rows{0, 2, 3}));
  EXPECT_EQ(Calibration("first:1", 4, {"z", "y", "z", "y"}), (Rows{0, 2}));
}

std::string FieldOf(const absl::Status& status) {
  const auto faults = FaultsOf(status);
  return faults.size() == 1 ? faults[0].field : "";
}

TEST(SplitFaults, Unreadable) {
  for (const char* text :
       {"odd-even", "first", "first:0", "first:-3", "first:x", "first:2:3", "every:", "random",
        "random:-1", "random:1:0", "random:1:1", "random:1:x", "random:1:0.5:2",
        "column:", "column:a", "column:=a", "spaced:1.5"}) {
    EXPECT_EQ(FieldOf(ParseSplit(text).status()), "options.split") << text;
  }
}

absl::Status Apply(const std::string& text, int n, const Strings& groups = {},
                   const Strings& values = {}) {
  return ApplySplit(*ParseSplit(text), n, groups, values).status();
}

TEST(SplitFaults, MoreRowsThanThereAre) {
  EXPECT_EQ(FieldOf(Apply("first:6", 5)), "options.split");
  EXPECT_EQ(FieldOf(Apply("spaced:3", 5, {"a", "a", "a", "b", "b"})), "options.split");
}

TEST(SplitFaults, NothingToCalibrate) {
  EXPECT_EQ(FieldOf(Apply("column:p=a", 2, {}, {"a", "a"})), "options.split");
  EXPECT_EQ(FieldOf(Apply("", 0)), "options.split");
  EXPECT_EQ(FieldOf(Apply("random:1:0.001", 5)), "options.split");
}

TEST(SplitFaults, NoSuchValueAndDividedGroup) {
  EXPECT_EQ(FieldOf(Apply("column:p=z", 2, {}, {"a", "b"})), "options.split");
  EXPECT_EQ(FieldOf(Apply("column:p=a", 3, {"g", "g", "h"}, {"a", "b", "b"})), "options.split");
}

}  // namespace
}  // namespace truepose
