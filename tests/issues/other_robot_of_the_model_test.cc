// Symptom: the calibration and the table of one robot were taken for another one of its model,
// whose file differs in the name alone; the second robot went where the first one is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

constexpr char kSpec[] = R"(
verification_points: 1000
position_tolerance_mm: 0.2
box: {min_x_mm: 500, max_x_mm: 600, min_y_mm: -50, max_y_mm: 50, min_z_mm: 200, max_z_mm: 300,
      reference_joints: [3.14, -1.2, 1.8, -2.17, -1.57, 0]}
)";

class OtherRobotOfTheModel : public ::testing::Test {
 protected:
  void SetUp() override {
    Must({"simulate", own_, "--poses", "60", "--seed", "3", "--output", folder_.Path("s.csv"),
          "--truth", truth_});
    Must({"calibrate", "--local", "--robot", own_, "--session", folder_.Path("s.csv"), "--output",
          calibration_});
  }

  static void Must(const std::vector<std::string>& line) {
    const Ran ran = RunCli(line);
    ASSERT_EQ(ran.code, 0) << line[0] << ": " << ran.err;
  }
  Ran Compensate(const std::string& robot, const std::string& calibration) const {
    return RunCli(
        {"compensate", targets_, "--local", "--robot", robot, "--calibration", calibration});
  }
  Ran BuildTable(const std::string& robot) const {
    return RunCli({"table", "build", "--local", "--robot", robot, "--calibration", calibration_,
                   "--spec", folder_.Path("cell.yaml"), "--output", table_});
  }
  std::string Refused(const std::string& file, const std::string& what) const {
    return absl::StrCat(file, ": found ", what, " of robots/ur10, expected one of robots/ur10-7 (",
                        "--robot ", other_, ")");
  }
  // The calibration as another writer would have left it.
  std::string Replaced(const std::string& from, const std::string& to) const {
    return folder_.Write("replaced.json",
                         absl::StrReplaceAll(folder_.Read("ur10.json"), {{from, to}}));
  }

  const TempFolder folder_;
  const std::string own_ = Example("ur10.yaml");
  const std::string other_ = folder_.Write(
      "ur10-7.yaml", absl::StrReplaceAll(TextOf(own_), {{"robot: ur10\n", "robot: ur10-7\n"}}));
  const std::string calibration_ = folder_.Path("ur10.json"), truth_ = folder_.Path("truth.json"),
                    table_ = folder_.Path("ur10.tpct");
  const std::string targets_ =
      folder_.Write("targets.csv", "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n10,-80,70,9,50,0\n");
  const std::string cell_ = folder_.Write("cell.yaml", kSpec);
};

TEST_F(OtherRobotOfTheModel, ItsCalibrationIsRefused) {
  for (const std::string& calibration : {calibration_, truth_}) {
    const Ran ran = Compensate(other_, calibration);
    EXPECT_EQ(ran.code, 3) << ran.out;
    EXPECT_THAT(ran.err, HasSubstr(Refused(calibration, "a calibration")));
    EXPECT_EQ(Compensate(own_, calibration).code, 0);
  }
  const Ran built = BuildTable(other_);
  EXPECT_EQ(built.code, 3);
  EXPECT_THAT(built.err, HasSubstr(Refused(calibration_, "a calibration")));
}

// Catches: a refusal of files from before names were kept, and of URDF, which names a model.
TEST_F(OtherRobotOfTheModel, WhatHasNoNameIsTaken) {
  EXPECT_EQ(Compensate(other_, Replaced("robots/ur10/nominals/", "")).code, 0);
  const std::string urdf = folder_.Path("cell.urdf");
  Must({"robot", "export", other_, "--local", "--format", "urdf", "-o", urdf});
  EXPECT_EQ(Compensate(urdf, truth_).err.find("expected one of robots"), std::string::npos);
}

// Catches: a calibration of a server, whose name tells, taken for its neighbour's.
TEST_F(OtherRobotOfTheModel, AServersCalibrationIsRefused) {
  const std::string named = Replaced(R"("name":"")", R"("name":"robots/ur10/calibrations/1")");
  const Ran ran = Compensate(other_, named);
  EXPECT_EQ(ran.code, 3) << ran.out;
  EXPECT_THAT(ran.err, HasSubstr(Refused(named, "a calibration")));
}

TEST_F(OtherRobotOfTheModel, ItsTableIsRefused) {
  ASSERT_EQ(BuildTable(own_).code, 0);
  const std::string unnamed = Replaced("robots/ur10/nominals/", "");
  const auto verify = [&](const std::string& robot) {
    return RunCli(
        {"table", "verify", table_, "--against", unnamed, "--robot", robot, "--points", "1000"});
  };
  EXPECT_THAT(verify(other_).err, HasSubstr(Refused(table_, "a table")));
  EXPECT_EQ(verify(own_).code, 0) << verify(own_).err;
  const std::string program = folder_.Write("p.src", "PTP HOME\n");
  const auto correct = [&](const std::string& robot) {
    return RunCli({"program", "correct", program, "--table", table_, "--robot", robot, "--output",
                   folder_.Path("out.src")});
  };
  EXPECT_THAT(correct(other_).err, HasSubstr(Refused("--table " + table_, "a table")));
  EXPECT_EQ(correct(own_).code, 0) << correct(own_).err;
}

}  // namespace
}  // namespace truepose::cli
