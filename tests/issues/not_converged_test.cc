// Symptom: a run that ended at its iteration limit exited with 0, predicted an accuracy, and
// advised to look at units and joints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "client/cli/commands/calibrate.h"
#include "client/cli/outcome.h"
#include "core/base/fault.h"
#include "tests/cli/run.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

v1::Calibration Ended(const std::string& termination) {
  v1::Calibration calibration;
  calibration.mutable_report()->mutable_summary()->set_termination(termination);
  calibration.mutable_report()->set_verdict("do_not_apply");
  return calibration;
}

struct Delivered {
  absl::Status status;
  std::string out, err;
};

Delivered Deliver(const std::string& termination, bool json) {
  std::ostringstream out, err;
  const Console console{out, err};
  const Invocation invocation{console, json, "", {}};
  const absl::Status status =
      truepose::cli::Deliver(invocation, Ended(termination), std::nullopt, "next");
  PrintError(console, json, status);
  return {status, out.str(), err.str()};
}

TEST(NotConverged, IsExitCodeOneWithTheReport) {
  const Delivered ran = Deliver("iteration_limit", false);
  EXPECT_EQ(ExitCodeOf(ran.status), 1);
  EXPECT_THAT(ran.out, HasSubstr("--estimator levenberg_marquardt"));
  EXPECT_THAT(ran.out, Not(HasSubstr("units")));
  EXPECT_THAT(ran.err, HasSubstr("did not converge"));
}

// A program that reads one object finds the report, whatever the exit code.
TEST(NotConverged, IsOneObjectWithJson) {
  const Delivered ran = Deliver("failed", true);
  EXPECT_EQ(ExitCodeOf(ran.status), 1);
  EXPECT_EQ(At(OneObject(ran.out), "verdict"), "do_not_apply");
}

// A verdict is a result: do_not_apply of a run that converged ends with 0.
TEST(NotConverged, IsNotTheVerdict) {
  EXPECT_EQ(ExitCodeOf(Deliver("converged", false).status), 0);
}

// Readings that determine too little are faults of the input, as the documentation says.
TEST(NotDetermined, IsAFaultOfTheInput) {
  FaultList faults;
  faults.Add("base.x", "not determined by 2 readings", "more readings");
  EXPECT_EQ(ExitCodeOf(AsFaultOfInput(faults.ToStatus(absl::StatusCode::kFailedPrecondition))), 3);
  EXPECT_EQ(ExitCodeOf(AsFaultOfInput(absl::FailedPreconditionError("no"))), 1);
}

}  // namespace
}  // namespace truepose::cli
