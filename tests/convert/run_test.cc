// From messages to messages: what a report says is what was measured.
#include "convert/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "absl/strings/match.h"
#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

v1::Calibration MustRun(const v1::CalibrationInput& input) {
  auto calibration = RunCalibration(input);
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  return *std::move(calibration);
}

// Every part of a report is filled and consistent with the others.
TEST(RunCalibration, ReportIsWhole) {
  const v1::CalibrationInput input = SampleInput(61);
  const v1::Calibration calibration = MustRun(input);
  const v1::CalibrationReport& report = calibration.report();
  EXPECT_EQ(report.model(), "modified_incremental");
  EXPECT_EQ(report.estimator(), "levenberg_marquardt");
  EXPECT_EQ(report.joints_used(), "measured");
  EXPECT_EQ(report.sets().calibration().poses(), 31);
  EXPECT_EQ(report.sets().control().poses(), 30);
  EXPECT_EQ(report.sets().complete().poses(), 61);
  EXPECT_EQ(report.parameters().identified(), 30);
  EXPECT_EQ(report.parameters().values_size(), 30);
  EXPECT_EQ(calibration.covariance_size(), 900);
  EXPECT_EQ(report.summary().residuals(), 31 * 6);
  EXPECT_EQ(report.frames_size(), 2);
  EXPECT_EQ(calibration.residuals_size(), 61);
  EXPECT_TRUE(calibration.residuals(1).control());
  EXPECT_EQ(calibration.digest().size(), 64u);
  EXPECT_NE(report.sets().control().digest(), report.sets().calibration().digest());
  for (const v1::Redundancy& redundancy : report.redundancies())
    EXPECT_FALSE(redundancy.reason().empty());
  double squares = 0;
  for (const v1::RowResidual& residual : calibration.residuals()) {
    if (residual.control()) squares += residual.after_position_mm() * residual.after_position_mm();
  }
  EXPECT_NEAR(std::sqrt(squares / 30), report.sets().control().after().position_mm().rms(), 1e-12);
}

// Would catch measured poses of an instrument whose certificate had run out, and nobody is told.
TEST(RunCalibration, SaysThatACertificateHadExpired) {
  v1::CalibrationInput input = SampleInput();
  EXPECT_THAT(MustRun(input).report().warnings(), Not(Contains(HasSubstr("certificate"))));
  v1::Session& session = *input.mutable_sessions(0)->mutable_session();
  session.set_instrument("instruments/tracker");
  session.mutable_certificate_expired_time()->set_seconds(1740787200);  // 2025-03-01
  EXPECT_THAT(MustRun(input).report().warnings(),
              Contains(HasSubstr("certificate of instruments/tracker had expired on 2025-03-01")));
}

// Reported values are SI values in mm and deg, deviations the root of the covariance's diagonal.
TEST(RunCalibration, UnitsOfTheReport) {
  const v1::Calibration calibration = MustRun(SampleInput());
  int internal = 0;
  for (int i = 0; i < 30; ++i) {
    const v1::ParameterValue& value = calibration.report().parameters().values(i);
    const double scale = value.unit() == "mm" ? 1e3 : 180 / M_PI;
    if (i % 6 < 3 ||
        value.group() == v1::INTERNAL) {  // rotation vectors of frames have deviations of their own
      EXPECT_NEAR(value.sd(), std::sqrt(calibration.covariance(31 * i)) * scale, 1e-12);
    }
    for (const v1::InternalParameter& parameter : calibration.internal_parameters()) {
      if (parameter.name() != value.name()) continue;
      EXPECT_NEAR(value.identified(), parameter.value() * scale, 1e-12);
      EXPECT_EQ(value.nominal(), 0);
      EXPECT_EQ(value.group(), v1::INTERNAL);
      ++internal;
    }
  }
  EXPECT_EQ(internal, 18);
}

// The tool's nominal stands beside its identified place, and the simulated truth is found.
TEST(RunCalibration, ToolIsFoundWhereItIs) {
  v1::CalibrationInput input = SampleInput(200);
  input.mutable_options()->set_nominal_tool("pin");
  const v1::Calibration calibration = MustRun(input);
  for (const v1::ParameterValue& value : calibration.report().parameters().values()) {
    if (value.name() != "tool.z") continue;
    EXPECT_DOUBLE_EQ(value.nominal(), 161);
    EXPECT_NEAR(value.identified(), 161, 1.5);
  }
}

TEST(RunCalibration, ObserveTakesPartOfAReading) {
  v1::CalibrationInput input = SampleInput(100);
  input.mutable_options()->set_observe(v1::POINT);
  const v1::Calibration points = MustRun(input);
  EXPECT_EQ(points.report().parameters().identified(), 27);
  EXPECT_FALSE(points.report().sets().control().after().has_rotation_deg());
  input.mutable_options()->set_observe(v1::POINT_AXIS);
  EXPECT_EQ(MustRun(input).report().parameters().identified(), 29);
}

// Rows without the observed quantity are not used, are named, and keep their place in the count of
// the split.
TEST(RunCalibration, UnusableRowsKeepTheirPlace) {
  v1::CalibrationInput input = SampleInput(60);
  input.mutable_sessions(0)->mutable_readings(4)->clear_position_m();
  input.mutable_sessions(0)->mutable_readings(7)->clear_joints_measured();
  const v1::Calibration calibration = MustRun(input);
  EXPECT_EQ(calibration.report().sets().calibration().poses(), 29);
  EXPECT_EQ(calibration.report().sets().control().poses(), 29);
  ASSERT_EQ(calibration.report().warnings_size(), 1);
  EXPECT_THAT(calibration.report().warnings(0), HasSubstr("rows 4, 7"));
  for (const v1::RowResidual& residual : calibration.residuals())
    EXPECT_EQ(residual.control(), residual.row() % 2 == 1);
}

TEST(RunCalibration, CommandedWhereNotMeasured) {
  v1::CalibrationInput input = SampleInput(60);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings()) {
    reading.mutable_joints_commanded()->Swap(reading.mutable_joints_measured());
  }
  EXPECT_EQ(MustRun(input).report().joints_used(), "commanded");
  input.mutable_sessions(0)->mutable_readings(0)->mutable_joints_measured()->CopyFrom(
      input.sessions(0).readings(0).joints_commanded());
  EXPECT_EQ(MustRun(input).report().joints_used(), "measured (1 rows), commanded (59 rows)");
}

// Two sessions of one robot with their own set-ups: a base and a tool each, internal parameters in
// common.
TEST(RunCalibration, SessionsHaveTheirOwnFrames) {
  v1::CalibrationInput input = SampleInput(60);
  *input.add_sessions() = input.sessions(0);
  for (v1::Reading& reading : *input.mutable_sessions(1)->mutable_readings()) {
    reading.mutable_position_m()->set_x(reading.position_m().x() + 0.5);
  }
  const v1::Calibration calibration = MustRun(input);
  EXPECT_EQ(calibration.report().parameters().identified(), 18 + 24);
  EXPECT_EQ(calibration.report().frames_size(), 4);
  EXPECT_EQ(calibration.report().frames(1).name(), "session 2");
  EXPECT_EQ(calibration.report().sets().complete().poses(), 120);
  for (auto& session : *input.mutable_sessions()) {
    for (v1::Reading& reading : *session.mutable_readings()) reading.set_target("ball");
  }
  EXPECT_EQ(MustRun(input).report().parameters().identified(), 18 + 12 + 6)
      << "a named target is one for all sessions";
}

TEST(RunCalibration, GroupsAndColumns) {
  v1::CalibrationInput input = SampleInput(60, "column:day=2");
  input.mutable_sessions(0)->mutable_session()->add_extra_columns("day");
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings()) {
    reading.add_extra_values(std::to_string(reading.row() % 3));
    reading.set_group(std::to_string(reading.row() / 10));
  }
  EXPECT_EQ(MustRun(input).report().sets().control().poses(), 20);
  input.mutable_options()->set_split("even-odd");
  input.mutable_options()->set_group_column("group");
  const v1::Calibration grouped = MustRun(input);
  for (const v1::RowResidual& residual : grouped.residuals())
    EXPECT_EQ(residual.control(), residual.row() / 10 % 2 == 1);
}

// A calibration brought to the shop floor: the compensated robot is exact where the uncompensated
// one is off.
TEST(RunCompensation, JointTargetsAndPoseTargetsAgree) {
  const v1::CalibrationInput input = SampleInput(100);
  const v1::Calibration calibration = MustRun(input);
  v1::CompensateRequest request;
  request.set_tool("pin");
  v1::CompensationTarget* target = request.add_targets();
  for (double q : {0.1, 0.6, -0.9, 0.4, 0.8, 0.2}) target->add_joints(q);
  const auto by_joints = RunCompensation(input.nominal(), calibration, request);
  ASSERT_TRUE(by_joints.ok()) << by_joints.status();
  const v1::CompensatedTarget first = by_joints->targets(0);
  EXPECT_EQ(first.fault(), "");
  EXPECT_GT(first.position_correction_mm(), 0.01);
  EXPECT_LT(first.residual_position_mm(), 1e-9);
  // The pose that the uncalibrated controller would have been asked for gives the same joints.
  v1::Calibration none = calibration;
  for (v1::InternalParameter& parameter : *none.mutable_internal_parameters())
    parameter.set_value(0);
  const auto desired = RunCompensation(input.nominal(), none, request);
  ASSERT_TRUE(desired.ok());
  EXPECT_EQ(desired->targets(0).position_correction_mm(), 0);
  *request.mutable_targets(0)->mutable_pose() = desired->targets(0).pose();
  const auto by_pose = RunCompensation(input.nominal(), calibration, request);
  ASSERT_TRUE(by_pose.ok());
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(by_pose->targets(0).joints(i), first.joints(i), 1e-9);
}

// A target that can't be reached carries its fault, the others are corrected.
TEST(RunCompensation, OneBadTargetDoesNotSpoilTheRest) {
  const v1::CalibrationInput input = SampleInput(60);
  v1::CompensateRequest request;
  for (double first : {0.1, 3.4, 0.2}) {
    v1::CompensationTarget* target = request.add_targets();
    target->set_row(request.targets_size() - 1);
    for (double q : {first, 0.6, -0.9, 0.4, 0.8, 0.2}) target->add_joints(q);
  }
  v1::CompensationTarget* far = request.add_targets();
  far->mutable_pose()->set_x_m(9);
  far->mutable_pose()->set_qw(1);
  const auto response = RunCompensation(input.nominal(), MustRun(input), request);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->targets(0).fault(), "");
  EXPECT_EQ(response->targets(0).outcome(), v1::COMPENSATION_OK);
  EXPECT_FALSE(response->targets(0).has_joint());
  EXPECT_THAT(response->targets(1).fault(), HasSubstr("beyond its limits"));
  EXPECT_EQ(response->targets(1).outcome(), v1::COMPENSATION_BEYOND_LIMIT);
  EXPECT_TRUE(response->targets(1).has_joint());
  EXPECT_EQ(response->targets(1).joint(), 0);
  EXPECT_EQ(response->targets(1).joints_size(), 0);
  EXPECT_EQ(response->targets(1).row(), 1);
  EXPECT_EQ(response->targets(2).fault(), "");
  EXPECT_THAT(response->targets(3).fault(), HasSubstr("out of reach"));
  EXPECT_EQ(response->targets(3).outcome(), v1::COMPENSATION_UNREACHABLE);
}

// Would catch a program that has to read prose to learn why: the elbow stretched out, where the
// corrections of the wrist's joints grow without bound.
TEST(RunCompensation, NearASingularityIsSaidInOneWord) {
  const v1::CalibrationInput input = SampleInput(60);
  const v1::Calibration calibration = MustRun(input);
  v1::CompensateRequest request;
  for (double elbow : {0.0, 1e-5, 1e-4, 1e-3}) {
    v1::CompensationTarget* target = request.add_targets();
    for (double q : {0.1, 0.6, elbow, 0.4, 1e-9, 0.2}) target->add_joints(q);
  }
  const auto response = RunCompensation(input.nominal(), calibration, request);
  ASSERT_TRUE(response.ok()) << response.status();
  int singular = 0;
  for (const v1::CompensatedTarget& target : response->targets()) {
    const bool refused = target.outcome() == v1::COMPENSATION_NEAR_SINGULAR;
    EXPECT_EQ(refused, absl::StrContains(target.fault(), "singularity")) << target.fault();
    singular += refused ? 1 : 0;
  }
  EXPECT_GT(singular, 0) << response->DebugString();
}

// A measuring robot: joints in, the true tip out. Correcting joints instead would be off by twice
// the error.
TEST(RunCompensation, MeasuringRobotGivesItsTip) {
  v1::CalibrationInput input;
  *input.mutable_nominal() = MeasuringRobot();
  const auto simulation = RunSimulation(input.nominal(), {});
  ASSERT_TRUE(simulation.ok());
  *input.add_sessions() = simulation->session;
  input.mutable_options()->set_split("even-odd");
  const v1::Calibration calibration = MustRun(input);
  v1::CompensateRequest request;
  request.set_tool("pin");
  *request.add_targets()->mutable_joints() = input.sessions(0).readings(3).joints_measured();
  request.add_targets()->mutable_pose()->set_qw(1);
  const auto response = RunCompensation(input.nominal(), calibration, request);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->targets(0).joints_size(), 0);
  EXPECT_GT(response->targets(0).position_correction_mm(), 0.05);
  EXPECT_EQ(response->targets(0).outcome(), v1::COMPENSATION_OK);
  EXPECT_THAT(response->targets(1).fault(), HasSubstr("measuring robot"));
  EXPECT_EQ(response->targets(1).outcome(), v1::COMPENSATION_INVALID_TARGET);
  // With no error at all the answer is the nominal tip; the distance of the two is the correction
  // that was told.
  v1::Calibration none = calibration;
  for (v1::InternalParameter& parameter : *none.mutable_internal_parameters())
    parameter.set_value(0);
  const auto nominal = RunCompensation(input.nominal(), none, request);
  ASSERT_TRUE(nominal.ok());
  const v1::Pose &a = response->targets(0).pose(), &b = nominal->targets(0).pose();
  EXPECT_NEAR(1e3 * std::hypot(a.x_m() - b.x_m(), a.y_m() - b.y_m(), a.z_m() - b.z_m()),
              response->targets(0).position_correction_mm(), 1e-9);
}

TEST(RunCompensation, DoNotApplyIsNotApplied) {
  const v1::CalibrationInput input = SampleInput(60);
  v1::Calibration calibration = MustRun(input);
  calibration.mutable_report()->set_verdict("do_not_apply");
  const absl::Status status = RunCompensation(input.nominal(), calibration, {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultsOf(status)[0].field, "calibration.report.verdict");
}

// A target that happens to be called what another gets as a label: two names, no abort.
TEST(RunCalibration, LabelsAreUnique) {
  v1::CalibrationInput input = SampleInput(60);
  *input.add_sessions() = input.sessions(0);
  for (v1::Reading& reading : *input.mutable_sessions(1)->mutable_readings())
    reading.set_target("session 1");
  const v1::Calibration calibration = MustRun(input);
  EXPECT_EQ(calibration.report().frames(2).name(), "session 1");
  EXPECT_EQ(calibration.report().frames(3).name(), "session 1'");
}

TEST(RunCompensation, FaultsOfTheRequest) {
  const v1::CalibrationInput input = SampleInput(60);
  v1::Calibration calibration = MustRun(input);
  v1::CompensateRequest request;
  request.add_targets();
  request.add_targets()->add_joints(1);
  request.add_targets()->mutable_pose()->set_x_m(NAN);
  std::vector<std::string> fields;
  for (const Fault& fault :
       FaultsOf(RunCompensation(input.nominal(), calibration, request).status()))
    fields.push_back(fault.field);
  EXPECT_THAT(fields, ElementsAre("targets[0]", "targets[1].joints", "targets[2].pose.x_m",
                                  "targets[2].pose"));
  calibration.mutable_internal_parameters(0)->set_name("elsewhere");
  calibration.mutable_report()->set_convention("older");
  fields.clear();
  for (const Fault& fault : FaultsOf(RunCompensation(input.nominal(), calibration, {}).status()))
    fields.push_back(fault.field);
  EXPECT_THAT(fields, ElementsAre("calibration.report.convention",
                                  "calibration.internal_parameters[0].name"));
}

TEST(RunEvaluation, SameRobotAnotherSession) {
  const v1::CalibrationInput input = SampleInput(100);
  const v1::Calibration calibration = MustRun(input);
  v1::SessionInput other = input.sessions(0);
  other.mutable_session()->set_name("sessions/other");
  for (v1::Reading& reading : *other.mutable_readings())
    reading.mutable_position_m()->set_z(reading.position_m().z() - 1);
  const auto evaluation =
      RunEvaluation(input.nominal(), calibration, other, v1::OBSERVE_UNSPECIFIED);
  ASSERT_TRUE(evaluation.ok()) << evaluation.status();
  EXPECT_EQ(evaluation->session(), "sessions/other");
  EXPECT_EQ(evaluation->set().poses(), 100);
  EXPECT_LT(evaluation->set().after().position_mm().rms(),
            evaluation->set().before().position_mm().rms() / 3);
  EXPECT_EQ(evaluation->residuals_size(), 100);
  EXPECT_EQ(evaluation->frames(0).fitted_on(), "its own rows");
}

// The simulated truth explains the simulated readings: identified values are within some deviations
// of it in every direction that is identifiable. A simulation of another robot would be far off.
TEST(RunSimulation, TruthExplainsTheReadings) {
  const v1::CalibrationInput input = SampleInput(200, "");
  const v1::Calibration calibration = MustRun(input);
  EXPECT_LT(calibration.report().sets().complete().after().position_mm().rms(), 0.1);
  EXPECT_NEAR(calibration.report().summary().model_sd_position_mm(), 0, 0.02)
      << "the stated noise explains the residuals";
  SimulationOptions bad;
  bad.poses = 0;
  bad.joint_noise_sd = -1;
  EXPECT_EQ(FaultsOf(RunSimulation(SampleNominal(), bad).status()).size(), 2u);
}

// A digest changes with every field of its content, and only then.
TEST(Digests, CoverTheirContent) {
  const v1::Nominal nominal = SampleNominal();
  v1::Nominal other = nominal;
  EXPECT_EQ(NominalDigest(nominal), NominalDigest(other));
  other.mutable_joints(2)->set_upper(2.9);
  EXPECT_NE(NominalDigest(nominal), NominalDigest(other));
  other = nominal;
  other.mutable_geometry()->mutable_standard_dh()->mutable_rows(0)->set_d_m(0.25200000000000006);
  EXPECT_NE(NominalDigest(nominal), NominalDigest(other)) << "the last bit of a length counts";
  std::vector<v1::Reading> readings(2);
  readings[1].set_row(1);
  const std::string digest = ReadingsDigest(readings);
  readings[0].set_group("x");
  EXPECT_NE(ReadingsDigest(readings), digest);
  v1::CalibrationOptions options;
  const std::string job = JobInputDigest("n", {"a", "b"}, options);
  EXPECT_NE(JobInputDigest("n", {"b", "a"}, options), job);
  options.set_require_complete(true);
  EXPECT_NE(JobInputDigest("n", {"a", "b"}, options), job);
}

TEST(Hooks, CancelAndProgress) {
  const v1::CalibrationInput input = SampleInput(60);
  RunHooks hooks;
  std::vector<std::string> stages;
  hooks.on_progress = [&](const v1::JobProgress& progress) {
    if (stages.empty() || stages.back() != progress.stage()) stages.push_back(progress.stage());
  };
  ASSERT_TRUE(RunCalibration(input, hooks).ok());
  EXPECT_THAT(stages, ElementsAre("start_values", "identification", "assessment"));
  hooks.is_cancelled = [] { return true; };
  EXPECT_EQ(RunCalibration(input, hooks).status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace truepose::convert
