#include "core/base/fault.h"

#include <gtest/gtest.h>

#include "core/base/status_macros.h"

namespace truepose {
namespace {

// Would catch a payload that loses a field, or a text with tab, newline or backslash that splits
// one fault into two.
TEST(Fault, StatusCarriesAllFaultsUnchanged) {
  FaultList list;
  list.Add("a.csv:3: q1_rad", "'x\ty\n\\t\\'", "a number");
  list.Add("b", "", "");
  const absl::Status status = list.ToStatus();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultsOf(status), list.faults());
  EXPECT_NE(status.message().find("found 'x"), std::string::npos);
}

TEST(Fault, EmptyListIsOk) { EXPECT_TRUE(FaultList().ToStatus().ok()); }

TEST(Fault, CodeIsTheCallers) {
  FaultList list;
  list.Add("a", "b", "c");
  EXPECT_EQ(list.ToStatus(absl::StatusCode::kFailedPrecondition).code(),
            absl::StatusCode::kFailedPrecondition);
}

// A file of the wrong kind: 200 faults are enough to read, and the rest is counted.
TEST(Fault, LongListIsCut) {
  FaultList list;
  for (int i = 0; i < 250; ++i) list.Add("f", "x", "y");
  const absl::Status status = list.ToStatus();
  EXPECT_EQ(FaultsOf(status).size(), 200u);
  EXPECT_NE(status.message().find("and 50 more"), std::string::npos);
  FaultList again;
  again.Add("one", "x", "y");
  again.AddAll(status);
  EXPECT_NE(again.ToStatus().message().find("and 51 more"), std::string::npos)
      << "taken over by another list, the cut ones still count";
}

TEST(Fault, AddAllPrefixesFields) {
  FaultList outer;
  outer.AddAll(absl::OkStatus(), "p.");
  EXPECT_TRUE(outer.empty());
  outer.AddAll(FaultStatus("x", "1", "2"), "p.");
  outer.AddAll(absl::NotFoundError("gone"), "q");
  EXPECT_EQ(outer.faults(), (std::vector<Fault>{{"p.x", "1", "2"}, {"q", "gone", ""}}));
}

TEST(Fault, StatusWithoutFaultsHasNone) { EXPECT_TRUE(FaultsOf(absl::NotFoundError("x")).empty()); }

absl::StatusOr<int> Twice(absl::StatusOr<int> value) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int v, value);
  TRUEPOSE_RETURN_IF_ERROR(v > 100 ? absl::OutOfRangeError("large") : absl::OkStatus());
  return 2 * v;
}

TEST(StatusMacros, ReturnEarly) {
  EXPECT_EQ(*Twice(4), 8);
  EXPECT_EQ(Twice(absl::AbortedError("a")).status().code(), absl::StatusCode::kAborted);
  EXPECT_EQ(Twice(101).status().code(), absl::StatusCode::kOutOfRange);
}

}  // namespace
}  // namespace truepose
