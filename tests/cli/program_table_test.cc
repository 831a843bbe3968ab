// `truepose program correct --table`: by a table's file alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "compensation/correct_by_table.h"
#include "compensation/encode_table.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"
#include "tests/compensation/table_samples.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

class ProgramTableTest : public ::testing::Test {
 protected:
  void SetUp() override {
    compensation::testing::FillNodes(&content_);
    const std::vector<std::byte> bytes = compensation::Encode(content_);
    folder_.Write("t.tpct", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  Ran Correct(const std::string& program, std::vector<std::string> more = {}) const {
    std::vector<std::string> line = {"program", "correct",  program, "--table",
                                     table_,    "--output", output_};
    line.insert(line.end(), more.begin(), more.end());
    return RunCli(line);
  }

  // Coordinates in the middle of each axis of the domain, as controller joints (the sample has no
  // joint map) in degrees.
  std::vector<double> MiddleDeg() const {
    std::vector<double> u;
    for (int i = 0; i < 6; ++i) {
      const compensation::TableAxis& axis = content_.axis[static_cast<size_t>(i)];
      u.push_back(0.4 * axis.lower + 0.6 * axis.upper);
    }
    std::vector<double> joints;
    const auto q = compensation::testing::JointsAt(content_, u);
    for (int j = 0; j < 6; ++j)
      joints.push_back(q[static_cast<size_t>(j)] * 180.0 / std::numbers::pi);
    return joints;
  }

  // Names the calibration of which the table is.
  std::string Mark() const {
    std::string hex;
    for (const auto byte : content_.header.calibration_digest)
      absl::StrAppend(&hex, absl::StrFormat("%02x", std::to_integer<unsigned>(std::byte(byte))));
    return absl::StrCat("; corrected by truepose, calibration ", hex,
                        ": correct the original, not this file\n");
  }

  static std::string Ptp(const std::vector<double>& deg) {
    std::string text = "PTP {";
    for (size_t j = 0; j < deg.size(); ++j)
      absl::StrAppend(&text, j > 0 ? "," : "", "A", j + 1, " ", absl::StrFormat("%.6f", deg[j]));
    return text + "}\n";
  }

  const TempFolder folder_;
  compensation::TableContent content_ =
      compensation::testing::Ur10Content(compensation::testing::Ur10Arm(1e-4), {5, 5, 5, 5});
  const std::string table_ = folder_.Path("t.tpct"), output_ = folder_.Path("out.src");
};

// Would catch joints that are not those of the runtime library, which the robot's PC uses.
TEST_F(ProgramTableTest, JointsAreThoseOfTheTable) {
  const std::vector<double> deg = MiddleDeg();
  const Ran ran = Correct(folder_.Write("p.src", Ptp(deg)));
  ASSERT_EQ(ran.code, 0) << ran.err;
  std::vector<double> q;
  // As printed: six decimals.
  for (const double d : deg)
    q.push_back(std::stod(absl::StrFormat("%.6f", d)) / 180 * std::numbers::pi);
  const compensation::Table table = compensation::MakeTable(content_);
  const compensation::Correction corrected = compensation::CorrectByTable(table, q.data());
  ASSERT_EQ(corrected.outcome, compensation::Outcome::kOk);
  std::vector<double> expected;
  for (size_t j = 0; j < 6; ++j) expected.push_back(corrected.q[j] * 180 / std::numbers::pi);
  EXPECT_EQ(folder_.Read("out.src"), Mark() + Ptp(expected));
  EXPECT_NE(folder_.Read("out.src"), Mark() + Ptp(deg));
}

// Would catch extrapolation, and a reason that names no joint or leaves out by how much.
TEST_F(ProgramTableTest, OutsideTheDomainIsRefused) {
  std::vector<double> deg = MiddleDeg();
  deg[2] += 720;
  const Ran ran = Correct(folder_.Write("p.src", Ptp(MiddleDeg()) + Ptp(deg)));
  EXPECT_EQ(ran.code, 3);
  const compensation::TableAxis& axis = content_.axis[2];
  EXPECT_THAT(
      ran.err,
      HasSubstr(absl::StrFormat(
          "p.src:2: PTP: outside the domain of the table in q3 %.2f, range %.2f to %.2f deg",
          deg[2], axis.lower * 180 / std::numbers::pi, axis.upper * 180 / std::numbers::pi)));
  EXPECT_EQ(folder_.Read("out.src"), "");
}

// Would catch a limit that is named without the joint's value and range.
TEST_F(ProgramTableTest, BeyondALimitIsRefusedWithValueAndRange) {
  const std::vector<double> deg = MiddleDeg();
  for (compensation::JointLimits& limits : content_.arm.limits)
    limits = {deg[4] * std::numbers::pi / 180 + 1, 10};  // which joint 5 never is within
  for (int j = 0; j < 6; ++j)
    if (j != 4) content_.arm.limits[static_cast<size_t>(j)] = {-10, 10};
  const std::vector<std::byte> bytes = compensation::Encode(content_);
  folder_.Write("t.tpct", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const Ran ran = Correct(folder_.Write("p.src", Ptp(deg)));
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("joint 5 is beyond its limits: "));
  EXPECT_THAT(ran.err,
              HasSubstr(absl::StrFormat(", range %.2f to %.2f deg", deg[4] + 180 / std::numbers::pi,
                                        1800 / std::numbers::pi)));
}

// Would catch a table that is not whole, or of another robot, being used.
TEST_F(ProgramTableTest, OtherFilesAreRefused) {
  const std::string program = folder_.Write("p.src", Ptp(MiddleDeg()));
  std::string bytes = folder_.Read("t.tpct");
  const Ran other = Correct(program, {"--robot", Example("ur10.yaml")});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(
      other.err,
      HasSubstr("--table " + table_ +
                ": other nominal robot: nominal_digest: found that of another nominal robot, "
                "expected a table of that robot, or with --robot the file of the robot that the "
                "table is of"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  folder_.Write("t.tpct", bytes);
  const Ran damaged = Correct(program);
  EXPECT_EQ(damaged.code, 3);
  EXPECT_THAT(damaged.err, HasSubstr("--table " + table_ + ": damaged: "));
}

TEST_F(ProgramTableTest, OneOfTableAndCalibration) {
  const std::string program = folder_.Write("p.src", Ptp(MiddleDeg()));
  EXPECT_EQ(Correct(program, {"--calibration", "ur10#1"}).code, 2);
  EXPECT_EQ(RunCli({"program", "correct", program, "--output", output_}).code, 2);
}

}  // namespace
}  // namespace truepose::cli
