#include "formats/field_lines.h"

#include "core/base/fault.h"
#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

FieldLines SomeLines() {
  FieldLines lines("ur10.yaml");
  lines.Set("joints", 3);
  lines.Set("joints[2]", 6);
  lines.Set("joints[2].lower", 7);
  return lines;
}

// Catches: a deeper field without a line of its own that loses the line of what encloses it.
TEST(FieldLinesTest, TakesTheNearestEnclosingField) {
  const FieldLines lines = SomeLines();
  EXPECT_EQ(lines.LineOf("joints[2].lower"), 7);
  EXPECT_EQ(lines.LineOf("joints[2].upper"), 6);
  EXPECT_EQ(lines.LineOf("joints[5].upper"), 3);
  EXPECT_EQ(lines.LineOf("nominal.joints[2].lower"), 7);
  EXPECT_EQ(lines.LineOf("tools[0]"), 0);
}

TEST(FieldLinesTest, LocatesFaultsOfAStatus) {
  FaultList faults;
  faults.Add("joints[2].lower", "4 rad", "less than upper");
  faults.Add("tools[0]", "a", "b");
  const absl::Status located =
      LocateFaults(faults.ToStatus(absl::StatusCode::kFailedPrecondition), SomeLines());
  EXPECT_EQ(located.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(located.message(),
            "ur10.yaml:7: joints[2].lower: found 4 rad, expected less than upper\n"
            "ur10.yaml: tools[0]: found a, expected b");
}

// Catches: an error without faults, or success, that gets lost on the way.
TEST(FieldLinesTest, LeavesOtherStatusesAlone) {
  EXPECT_TRUE(LocateFaults(absl::OkStatus(), SomeLines()).ok());
  EXPECT_EQ(LocateFaults(absl::CancelledError("x"), SomeLines()), absl::CancelledError("x"));
}

}  // namespace
}  // namespace truepose::formats
