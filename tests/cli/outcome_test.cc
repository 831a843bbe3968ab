#include "client/cli/outcome.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/fault.h"

namespace truepose::cli {
namespace {

// Would catch a script that is told the wrong thing; the numbers are a promise of `truepose
// --help`.
TEST(ExitCodeOf, FollowsTheDocumentedNumbers) {
  EXPECT_EQ(ExitCodeOf(absl::OkStatus()), 0);
  EXPECT_EQ(ExitCodeOf(absl::FailedPreconditionError("")), 1);
  EXPECT_EQ(ExitCodeOf(absl::CancelledError("")), 1);
  EXPECT_EQ(ExitCodeOf(absl::InternalError("")), 1);
  EXPECT_EQ(ExitCodeOf(UsageError("")), 2);
  EXPECT_EQ(ExitCodeOf(absl::InvalidArgumentError("")), 3);
  EXPECT_EQ(ExitCodeOf(absl::AlreadyExistsError("")), 3);
  EXPECT_EQ(ExitCodeOf(absl::UnavailableError("")), 4);
  EXPECT_EQ(ExitCodeOf(absl::DataLossError("")), 5);
  EXPECT_EQ(ExitCodeOf(absl::NotFoundError("")), 6);
}

// Would catch a missing file reported as an unknown robot, and faults lost when the code changes.
TEST(AsInputFault, ChangesTheCodeAndKeepsTheFaults) {
  FaultList faults;
  faults.Add("a.csv", "no such file", "a readable file");
  const absl::Status status = AsInputFault(faults.ToStatus(absl::StatusCode::kNotFound));
  EXPECT_EQ(ExitCodeOf(status), 3);
  EXPECT_EQ(FaultsOf(status), faults.faults());
  EXPECT_TRUE(AsInputFault(absl::OkStatus()).ok());
}

// Would catch a hint on errors it does not belong to, and a usage error that loses its exit code by
// a hint.
TEST(WithHint, AddsALineToThatCodeOnly) {
  EXPECT_EQ(WithHint(absl::NotFoundError("no"), absl::StatusCode::kNotFound, "try").message(),
            "no\ntry");
  EXPECT_EQ(WithHint(absl::InternalError("no"), absl::StatusCode::kNotFound, "try").message(),
            "no");
  EXPECT_EQ(ExitCodeOf(WithHint(UsageError("no"), absl::StatusCode::kInvalidArgument, "try")), 2);
}

// Would catch message fields where people typed options, and a status that loses code or text on
// the way.
TEST(RenameFields, ReplacesTheBeginningOfTheFirstThatFits) {
  FaultList faults;
  faults.Add("options.split", "'x'", "a split");
  faults.Add("sessions[0].readings[3]", "1", "2");
  faults.Add("other", "1", "2");
  const absl::Status status = RenameFields(
      faults.ToStatus(absl::StatusCode::kFailedPrecondition),
      {{"options.split", "--split"}, {"sessions[0].", "a.csv: "}, {"sessions[0]", "b"}});
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  const std::vector<Fault> renamed = FaultsOf(status);
  ASSERT_EQ(renamed.size(), 3u);
  EXPECT_EQ(renamed[0].field, "--split");
  EXPECT_EQ(renamed[1].field, "a.csv: readings[3]");
  EXPECT_EQ(renamed[2].field, "other");
  EXPECT_EQ(RenameFields(absl::InternalError("why"), {{"a", "b"}}).message(), "why");
  EXPECT_TRUE(RenameFields(absl::OkStatus(), {}).ok());
}

// Would catch errors on standard output where a reader expects results.
TEST(PrintError, GoesToErrAndOnlyWithJsonToOut) {
  std::ostringstream out, err;
  PrintError({out, err}, false, absl::NotFoundError("robots/x"));
  EXPECT_EQ(out.str(), "");
  EXPECT_EQ(err.str(), "truepose: robots/x\n");
  PrintError({out, err}, true, absl::NotFoundError("robots/x"));
  EXPECT_EQ(out.str(),
            "{\"error\":{\"code\":\"NOT_FOUND\",\"message\":\"robots/x\",\"faults\":[]}}\n");
}

TEST(PrintError, CountsAndIndentsSeveralFaults) {
  FaultList faults;
  faults.Add("a", "1", "2");
  faults.Add("b", "3", "4");
  std::ostringstream out, err;
  PrintError({out, err}, false, faults.ToStatus());
  EXPECT_EQ(err.str(), "truepose: 2 faults\n  a: found 1, expected 2\n  b: found 3, expected 4\n");
}

}  // namespace
}  // namespace truepose::cli
