// Tables and accuracy maps from messages.
#include "convert/table_build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compensation/table_file.h"
#include "convert/accuracy_map.h"
#include "convert/table_header.h"
#include "convert/table_verify.h"
#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::HasSubstr;

// A table of some seconds' work at most: a small part of the robot's joints.
v1::CompensationTableInput TableInput() {
  const v1::CalibrationInput calibrated = SampleInput();
  const auto calibration = RunCalibration(calibrated);
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  v1::CompensationTableInput input;
  input.set_robot("robots/sample");
  *input.mutable_nominal() = calibrated.nominal();
  input.mutable_nominal()->set_serial("S-1");
  *input.mutable_calibration() = *calibration;
  input.mutable_calibration()->set_name("robots/sample/calibrations/3");
  for (const double middle : {0.0, 0.5, -0.5, 0.0, 1.0, 0.0}) {
    v1::JointRange* range = input.mutable_spec()->mutable_joint_ranges()->add_joints();
    range->set_lower(middle - 0.4);
    range->set_upper(middle + 0.4);
  }
  input.mutable_spec()->set_verification_points(2000);
  return input;
}

compensation::TableFile Loaded(const TableFile& file) {
  compensation::TableFile loaded;
  const auto report = compensation::TableFile::Copy(
      std::as_bytes(std::span(file.bytes.data(), file.bytes.size())), {}, &loaded);
  EXPECT_TRUE(report.ok()) << report.message.data();
  return loaded;
}

// Would catch a header that does not say whose table it is, a file that no reader takes, and a
// message that is not what stands in the file.
TEST(TableBuild, FileSaysWhatItIs) {
  const v1::CompensationTableInput input = TableInput();
  const auto file = RunTableBuild(input);
  ASSERT_TRUE(file.ok()) << file.status();
  const compensation::TableFile loaded = Loaded(*file);
  const v1::CompensationTableHeader header = HeaderToProto(loaded.table());
  EXPECT_EQ(header.robot(), "robots/sample");
  EXPECT_EQ(header.serial(), "S-1");
  EXPECT_EQ(header.calibration(), "robots/sample/calibrations/3");
  EXPECT_EQ(header.calibration_digest(), input.calibration().digest());
  EXPECT_EQ(header.nominal_digest(), NominalDigest(input.nominal()));
  EXPECT_EQ(header.estimated().size_bytes(), static_cast<int64_t>(file->bytes.size()));
  EXPECT_GE(header.verification_points(), 2000);
  EXPECT_LE(header.verified().worst_position_m(), header.position_tolerance_m());
  EXPECT_EQ(header.position_tolerance_m(), 2e-5);
  EXPECT_EQ(header.SerializeAsString(), file->header.SerializeAsString());
}

// Sessions were simulated with 0.05 mm of noise: the predicted accuracy is of that size. Would
// catch an accuracy in other units, or one that is left out.
TEST(TableBuild, FileSaysHowAccurateTheToolWillBe) {
  const auto file = RunTableBuild(TableInput());
  ASSERT_TRUE(file.ok()) << file.status();
  ASSERT_TRUE(file->header.has_predicted_accuracy_95_m());
  EXPECT_GT(file->header.predicted_accuracy_95_m(), 2e-5);
  EXPECT_LT(file->header.predicted_accuracy_95_m(), 1e-3);
  v1::CompensationTableInput without = TableInput();
  without.mutable_calibration()->clear_covariance();
  EXPECT_FALSE(RunTableBuild(without)->header.has_predicted_accuracy_95_m());
}

// Would catch a prediction that leaves out what the table itself is off by: two tables of the same
// calibration and domain differ by that alone.
TEST(TableBuild, AccuracyHasTheTablesOwnErrorInIt) {
  v1::CompensationTableInput coarse = TableInput();
  coarse.mutable_spec()->set_position_tolerance_m(2e-3);
  coarse.mutable_spec()->set_rotation_tolerance_rad(2e-2);
  const auto fine = RunTableBuild(TableInput());
  const auto rough = RunTableBuild(coarse);
  ASSERT_TRUE(fine.ok() && rough.ok()) << rough.status();
  const double larger =
      rough->header.verified().position_95_m() - fine->header.verified().position_95_m();
  EXPECT_GT(larger, 5e-6);
  EXPECT_GE(rough->header.predicted_accuracy_95_m() - fine->header.predicted_accuracy_95_m(),
            larger * (1 - 1e-9));
}

// Would catch bytes that depend on the time.
TEST(TableBuild, EqualInputsGiveEqualBytes) {
  const v1::CompensationTableInput input = TableInput();
  EXPECT_EQ(RunTableBuild(input)->bytes, RunTableBuild(input)->bytes);
}

// Would catch a table of a calibration that its own report warns of.
TEST(TableBuild, RefusesWhatMustNotBeApplied) {
  v1::CompensationTableInput input = TableInput();
  input.mutable_calibration()->mutable_report()->set_verdict("do_not_apply");
  EXPECT_EQ(RunTableBuild(input).status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(RunTableEstimate(input).status().code(), absl::StatusCode::kFailedPrecondition);
}

// Would catch spec faults under other names than the message has.
TEST(TableBuild, NamesFaultsOfTheSpec) {
  v1::CompensationTableInput input = TableInput();
  input.mutable_spec()->mutable_joint_ranges()->mutable_joints(1)->set_upper(9);
  const auto refused = RunTableBuild(input);
  const auto faults = FaultsOf(refused.status());
  ASSERT_EQ(faults.size(), 1u) << refused.status();
  EXPECT_EQ(faults[0].field, "joint_ranges.joints[1].upper");
  input = TableInput();
  input.mutable_spec()->set_largest_bytes(10000);
  EXPECT_THAT(std::string(RunTableEstimate(input).status().message()), HasSubstr("loosen"));
}

// Would catch a verification that compares the table with itself: of another calibration it must
// fail, and of another robot's be refused.
TEST(TableVerify, HoldsATableAgainstItsCalibration) {
  const v1::CompensationTableInput input = TableInput();
  const auto file = RunTableBuild(input);
  ASSERT_TRUE(file.ok()) << file.status();
  const compensation::TableFile loaded = Loaded(*file);
  const auto verified =
      RunTableVerification(loaded.table(), input.nominal(), input.calibration(), {2000, 9});
  ASSERT_TRUE(verified.ok()) << verified.status();
  EXPECT_TRUE(verified->within_stated());
  EXPECT_GE(verified->points(), 2000);
  v1::Calibration changed = input.calibration();
  changed.mutable_internal_parameters(3)->set_value(changed.internal_parameters(3).value() + 1e-3);
  const auto off = RunTableVerification(loaded.table(), input.nominal(), changed, {2000, 9});
  ASSERT_TRUE(off.ok()) << off.status();
  EXPECT_FALSE(off->within_stated());
  changed.set_digest(std::string(64, '0'));
  EXPECT_EQ(
      FaultsOf(RunTableVerification(loaded.table(), input.nominal(), changed, {2000, 9}).status())
          .size(),
      1u);
}

// Would catch a map that leaves out its points, or one of a calibration that says nothing.
TEST(AccuracyMap, IsOfTheCalibration) {
  const v1::CompensationTableInput input = TableInput();
  v1::AccuracyMapSpec spec;
  v1::BoxDomain* box = spec.mutable_box();
  for (const double q : {0.0, 0.5, -0.5, 0.1, 1.0, 0.0}) box->add_reference_joints(q);
  box->set_min_x_m(0.3);
  box->set_max_x_m(0.6);
  box->set_min_y_m(-0.2);
  box->set_max_y_m(0.2);
  box->set_min_z_m(0.1);
  box->set_max_z_m(0.3);
  spec.set_points_z(2);
  const auto map = RunAccuracyMap(input.nominal(), input.calibration(), spec);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->points_size(), 13 * 13 * 2);
  EXPECT_EQ(map->spec().points_x(), 13);
  EXPECT_EQ(map->calibration_digest(), input.calibration().digest());
  EXPECT_GT(map->reached(), 0);
  EXPECT_GT(map->rms_mm(), 0.02);
  EXPECT_LT(map->rms_mm(), 1);
  EXPECT_LE(map->best_95_mm(), map->position_95_mm());
  v1::Calibration bare = input.calibration();
  bare.clear_covariance();
  EXPECT_EQ(RunAccuracyMap(input.nominal(), bare, spec).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace truepose::convert
