// A calibration's way to the robot on the command line.
#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

class ReleaseTest : public RemoteFixture {
 protected:
  // Two calibrations, and one person who may release them.
  void SetUp() override {
    RemoteFixture::SetUp();
    AddRobot();
    Demand({"robot", "update", "ur10", "--set", "release_policy=ONE_PERSON"});
    Import();
    Calibrate();
    Demand({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "first:30"});
  }
  std::string Active() const {
    return At(OneObject(Demand({"robot", "show", "ur10", "--json"}).out), "active_calibration");
  }
  void Release(const std::string& name) const {
    Demand({"calibration", "approve", name, "--reason", "checked with session B"});
    Demand({"calibration", "activate", name});
  }
};

// Would catch a step that goes elsewhere than it says, and a history without who and why.
TEST_F(ReleaseTest, FromDraftToTheRobotAndBack) {
  EXPECT_THAT(Demand({"calibration", "history", "ur10#1"}).out,
              HasSubstr("Next: truepose calibration approve ur10#1"));
  Release("ur10#1");
  EXPECT_EQ(Active(), "robots/ur10/calibrations/1");
  Release("ur10#2");
  EXPECT_EQ(Active(), "robots/ur10/calibrations/2");
  EXPECT_THAT(Demand({"calibration", "list"}).out, HasSubstr("superseded"));
  const Ran other = Remote({"calibration", "rollback", "ur10", "--from", "ur10#1"});
  EXPECT_EQ(other.code, 1);
  Demand({"calibration", "rollback", "ur10", "--from", "ur10#2", "--reason", "collision"});
  EXPECT_EQ(Active(), "robots/ur10/calibrations/1");
  const std::string history = Demand({"calibration", "history", "ur10#1"}).out;
  EXPECT_THAT(history, HasSubstr("checked with session B"));
  EXPECT_THAT(history, HasSubstr("collision"));
}

// Would catch steps out of order, a rejection without a reason, and a dry run that is none.
TEST_F(ReleaseTest, RefusalsSayWhatToDo) {
  const Ran early = Remote({"calibration", "activate", "ur10#1"});
  EXPECT_EQ(early.code, 1);
  EXPECT_THAT(early.err, HasSubstr("truepose calibration history"));
  const Ran silent = Remote({"calibration", "reject", "ur10#1"});
  EXPECT_EQ(silent.code, 3);
  EXPECT_THAT(silent.err, HasSubstr("--reason"));
  EXPECT_THAT(Demand({"calibration", "approve", "ur10#1", "--dry-run"}).out,
              HasSubstr("Dry run: nothing was changed."));
  EXPECT_THAT(Demand({"calibration", "history", "ur10#1"}).out, HasSubstr("ur10#1: draft"));
  Demand({"calibration", "reject", "ur10#1", "--reason", "loose target"});
  EXPECT_EQ(Remote({"calibration", "approve", "ur10#1"}).code, 1);
  EXPECT_EQ(Remote({"calibration", "approve", "ur10#9"}).code, 6);
  EXPECT_EQ(Remote({"calibration", "approve", "ur10"}).code, 3);
}

// Would catch a page on which the calibrations or the nominal robot are mixed up.
TEST_F(ReleaseTest, AsFoundAndAsLeftOnOnePage) {
  const Ran page = Demand({"calibration", "compare", "ur10#1", "ur10#2", "--session", kUuid});
  EXPECT_THAT(page.out, HasSubstr(absl::StrCat("Session ", kUuid, "\n")));
  EXPECT_THAT(page.out, HasSubstr("nominal"));
  EXPECT_THAT(page.out, HasSubstr("ur10#1       as found"));
  EXPECT_THAT(page.out, HasSubstr("ur10#2       as left"));
  const auto json = OneObject(
      Demand({"calibration", "compare", "ur10#1", "ur10#2", "--session", kUuid, "--json"}).out);
  const auto evaluated =
      OneObject(Demand({"evaluate", "--calibration", "ur10#2", "--session", kUuid, "--json"}).out);
  EXPECT_EQ(At(json, "evaluations.1.set.after.position_mm.rms"),
            At(evaluated, "set.after.position_mm.rms"));
  const Ran wrong = Remote({"calibration", "compare", "one", "two", "--session", kUuid});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("2 faults"));
}

// Would catch a preview that runs, or that counts otherwise than the run.
TEST_F(ReleaseTest, APreviewRunsNothing) {
  const std::vector<std::string> line = {"calibrate", "--robot",   "ur10",    "--session",
                                         kUuid,       "--preview", "--split", "even-odd"};
  const std::string text = Demand(line).out;
  EXPECT_THAT(text, HasSubstr("Preview: nothing was run."));
  EXPECT_THAT(text, HasSubstr("4R + 2P + 6 = 30"));
  EXPECT_EQ(At(OneObject(Demand({"job", "list", "--json"}).out), "jobs"), "[2]");
  EXPECT_EQ(text, RunCli({"calibrate", "--local", "--robot", robot_, "--session", session_,
                          "--preview", "--split", "even-odd"})
                      .out);
  EXPECT_EQ(
      Remote({"calibrate", "--robot", "ur10", "--session", kUuid, "--preview", "--no-wait"}).code,
      2);
}

}  // namespace
}  // namespace truepose::cli
