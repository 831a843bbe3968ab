// Robots out of Truepose and back in by their files: what comes back moves as the calibration does.
#include "convert/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "absl/strings/numbers.h"
#include "convert/calibrated_model.h"
#include "convert/robot.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/robot/dh.h"
#include "formats/csv.h"
#include "formats/dh_table.h"
#include "formats/joint_origins.h"
#include "formats/robot_file.h"
#include "formats/ur_calibration.h"
#include "formats/urdf.h"

namespace truepose::convert {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// What is asked of an export. Measured: some 1e-14; D&H with normals a kilometre away, 1e-12.
constexpr double kSame_m = 1e-9;
constexpr double kSame_rad = 1e-9;

v1::Nominal Example(const std::string& name) {
  const auto file = formats::ReadRobotFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/" + name);
  EXPECT_TRUE(file.ok()) << file.status();
  return file->nominal;
}

std::vector<v1::Nominal> Examples() {
  return {Example("ur10.yaml"), Example("franka_panda.yaml"), Example("stanford.yaml"),
          Example("measuring_robot.yaml")};
}

// Errors of half a millimetre and half a milliradian in every parameter.
v1::Calibration Truth(const v1::Nominal& nominal, unsigned long long seed = 4) {
  SimulationOptions options;
  options.poses = 2;
  options.seed = seed;
  const auto simulation = RunSimulation(nominal, options);
  EXPECT_TRUE(simulation.ok()) << simulation.status();
  v1::Calibration calibration;
  calibration.mutable_report()->set_convention(simulation->convention);
  for (const v1::InternalParameter& parameter : simulation->truth)
    *calibration.add_internal_parameters() = parameter;
  return calibration;
}

// The calibration's X_BF at controller joints.
class Prediction {
 public:
  Prediction(const v1::Nominal& nominal, const v1::Calibration& calibration)
      : robot_(*RobotFrom(nominal)), calibrated_(*CalibratedModelFrom(robot_, calibration)) {}

  Pose operator()(const Eigen::VectorXd& q) const {
    return Forward(calibrated_.model, robot_.joint_map().ToChain(q), calibrated_.lambda);
  }
  int joints() const { return robot_.joint_count(); }

 private:
  Robot robot_;
  CalibratedModel calibrated_;
};

void ExpectSame(const Prediction& expected, const v1::Nominal& read) {
  const auto robot = RobotFrom(read);
  ASSERT_TRUE(robot.ok()) << robot.status();
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    Eigen::VectorXd q(expected.joints());
    for (double& value : q) value = random.Uniform(-3, 3);
    const Pose a = NominalForward(*robot, q), b = expected(q);
    EXPECT_LT((a.p - b.p).norm(), kSame_m);
    EXPECT_LT((a.R - b.R).norm(), kSame_rad);
  }
}

v1::Nominal ThroughUrdf(const v1::Nominal& nominal) {
  const auto text = formats::WriteUrdf({"r", nominal, formats::FieldLines()});
  EXPECT_TRUE(text.ok()) << text.status();
  const auto file = formats::ParseUrdf(*text, "r.urdf", {});
  EXPECT_TRUE(file.ok()) << file.status() << *text;
  return file.ok() ? file->nominal : v1::Nominal();
}

v1::Nominal ThroughYaml(const v1::Nominal& nominal) {
  const std::string text = formats::WriteRobotFile({"r", nominal, formats::FieldLines()});
  const auto file = formats::ParseRobotFile(text, "r.yaml");
  EXPECT_TRUE(file.ok()) << file.status() << text;
  return file.ok() ? file->nominal : v1::Nominal();
}

// Would catch an axis, origin or angle that URDF means otherwise, and digits lost in the text.
TEST(Export, UrdfReadsBackAsTheCalibration) {
  for (const v1::Nominal& nominal : Examples()) {
    SCOPED_TRACE(nominal.model());
    const v1::Calibration calibration = Truth(nominal);
    const auto exported = ExportJointFrames(nominal, &calibration);
    ASSERT_TRUE(exported.ok()) << exported.status();
    const v1::Nominal read = ThroughUrdf(exported->nominal);
    ExpectSame({nominal, calibration}, read);
    ASSERT_EQ(read.joints_size(), nominal.joints_size());
    for (int i = 0; i < read.joints_size(); ++i)
      EXPECT_EQ(read.joints(i).ShortDebugString(), nominal.joints(i).ShortDebugString());
  }
}

TEST(Export, RobotFileReadsBackAsTheCalibration) {
  for (const v1::Nominal& nominal : Examples()) {
    SCOPED_TRACE(nominal.model());
    const v1::Calibration calibration = Truth(nominal);
    const auto exported = ExportRobot(nominal, &calibration);
    ASSERT_TRUE(exported.ok()) << exported.status();
    EXPECT_TRUE(exported->nominal.geometry().has_standard_dh());
    const v1::Nominal read = ThroughYaml(exported->nominal);
    ExpectSame({nominal, calibration}, read);
    EXPECT_EQ(read.tools_size(), nominal.tools_size());
  }
}

double Number(std::string_view cell) {
  double value = std::nan("");
  EXPECT_TRUE(absl::SimpleAtod({cell.data(), cell.size()}, &value)) << cell;
  return value;
}

// A reader of the CSV that knows no more than its header says.
Chain ChainOfCsv(const std::string& text) {
  FaultList faults;
  const formats::CsvTable table = formats::ParseCsv(text, "dh.csv", faults);
  EXPECT_TRUE(faults.empty());
  Chain chain;
  int joint = 0;
  for (const formats::CsvRow& row : table.rows) {
    const DhRow dh{Number(row.cells[3]), Number(row.cells[4]), Number(row.cells[5]),
                   Number(row.cells[6])};
    const bool prismatic = row.cells[2] == "prismatic";
    Chain link =
        ChainFromStandardDh({dh}, {prismatic ? JointType::kPrismatic : JointType::kRevolute});
    link[prismatic ? 1 : 0].joint = row.cells[2] == "constant" ? -1 : joint++;
    chain.insert(chain.end(), link.begin(), link.end());
  }
  return chain;
}

TEST(Export, DhTableReadsBackAsTheCalibration) {
  for (const v1::Nominal& nominal : Examples()) {
    SCOPED_TRACE(nominal.model());
    const v1::Calibration calibration = Truth(nominal);
    const auto exported = ExportDhTable(nominal, &calibration);
    ASSERT_TRUE(exported.ok()) << exported.status();
    const Chain chain = ChainOfCsv(formats::WriteDhTable(nominal, exported->table));
    const Prediction prediction(nominal, calibration);
    Random random(12);
    for (int i = 0; i < 100; ++i) {
      Eigen::VectorXd q(prediction.joints());
      for (double& value : q) value = random.Uniform(-3, 3);
      const Pose a = Forward<double>(chain, q.data(), nullptr), b = prediction(q);
      EXPECT_LT((a.p - b.p).norm(), kSame_m);
      EXPECT_LT((a.R - b.R).norm(), kSame_rad);
    }
  }
}

// The UR10's axes 2, 3 and 4 are nominally parallel: would catch a table that hides why its d are
// hundreds of metres, and a warning where a table is an ordinary one.
TEST(Export, NearlyParallelAxesAreNamed) {
  const v1::Nominal ur10 = Example("ur10.yaml");
  const v1::Calibration calibration = Truth(ur10);
  const auto exported = ExportDhTable(ur10, &calibration);
  ASSERT_TRUE(exported.ok()) << exported.status();
  ASSERT_EQ(exported->warnings.size(), 3u);
  EXPECT_THAT(exported->warnings[0], HasSubstr("the axes of shoulder_lift and elbow are nearly"));
  EXPECT_THAT(exported->warnings[1], HasSubstr("the axes of elbow and wrist_1 are nearly"));
  EXPECT_THAT(exported->warnings[2], HasSubstr("leads back"));
  EXPECT_THAT(ExportDhTable(ur10, nullptr)->warnings, IsEmpty());
  const v1::Nominal stanford = Example("stanford.yaml");
  const v1::Calibration other = Truth(stanford);
  EXPECT_THAT(ExportDhTable(stanford, &other)->warnings, IsEmpty());
}

// 1e-6 rad between axes 2 and 3: d is 600 km. Would catch a file that no robot reader takes.
TEST(Export, ATableBeyondReachIsAChainInstead) {
  const v1::Nominal ur10 = Example("ur10.yaml");
  v1::Calibration calibration = Truth(ur10);
  for (v1::InternalParameter& parameter : *calibration.mutable_internal_parameters())
    parameter.set_value(parameter.name() == "dbeta2" ? 1e-6 : 0);
  const auto table = ExportDhTable(ur10, &calibration);
  ASSERT_EQ(FaultsOf(table.status()).size(), 2u) << table.status();
  EXPECT_THAT(FaultsOf(table.status())[0].found, HasSubstr("shoulder_lift and elbow"));
  const auto robot = ExportRobot(ur10, &calibration);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_TRUE(robot->nominal.geometry().has_chain());
  EXPECT_THAT(robot->warnings.back(), HasSubstr("chain of joint frames"));
  ExpectSame({ur10, calibration}, ThroughYaml(robot->nominal));
}

// Turned joints, offsets and a base off the first axis: would catch a joint map that is lost, or
// applied twice.
TEST(Export, JointMapsAndOddBasesSurvive) {
  const auto file = formats::ParseRobotFile(
      "robot: odd\n"
      "joints: [{name: a, type: revolute}, {name: b, type: prismatic, lower_mm: -100, upper_mm: "
      "200}, {name: c, type: revolute}]\n"
      "geometry:\n"
      "  chain: [{ty_mm: 300}, {rx_deg: 40}, {ry_joint: a}, {tx_mm: 200}, {tx_joint: b}, {rz_deg: "
      "90}, {rx_joint: c}, {tz_mm: 50}, {ry_deg: 90}]\n"
      "joint_map: {scale: [[-1, 0, 0], [0, -1, 0], [0, 0, 1]], offset_deg: [90, 0, -30], "
      "offset_mm: [0, 20, 0]}\n",
      "odd.yaml");
  ASSERT_TRUE(file.ok()) << file.status();
  const v1::Calibration calibration = Truth(file->nominal);
  const Prediction prediction(file->nominal, calibration);
  const auto urdf = ExportJointFrames(file->nominal, &calibration);
  ASSERT_TRUE(urdf.ok()) << urdf.status();
  ExpectSame(prediction, ThroughUrdf(urdf->nominal));
  const auto robot = ExportRobot(file->nominal, &calibration);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_TRUE(robot->nominal.has_joint_map());
  ExpectSame(prediction, ThroughYaml(robot->nominal));
}

v1::Nominal ThroughUrCalibration(const v1::Nominal& nominal) {
  const auto text = formats::WriteUrCalibration({nominal.geometry(), "calib_1"});
  EXPECT_TRUE(text.ok()) << text.status();
  const auto read = formats::ParseUrCalibration(*text, "ur.yaml");
  EXPECT_TRUE(read.ok()) << read.status();
  v1::Nominal result = nominal;
  *result.mutable_geometry() = read->geometry;
  return result;
}

TEST(Export, UrCalibrationReadsBackAsTheCalibration) {
  const v1::Nominal ur10 = Example("ur10.yaml");
  for (unsigned long long seed : {4, 5, 6}) {
    const v1::Calibration calibration = Truth(ur10, seed);
    const auto exported = ExportUrCalibration(ur10, &calibration);
    ASSERT_TRUE(exported.ok()) << exported.status();
    ExpectSame({ur10, calibration}, ThroughUrCalibration(exported->nominal));
  }
}

// The file that ur_description comes with for this robot: d1 in shoulder, a2 and a3 along x, d4 in
// wrist_1, d5 along -y of wrist_2, d6 along y of wrist_3 (its rpy of pi/2, pi, pi is -pi/2, 0, 0).
// Would catch frames that carry the links' meshes to other places than the driver's do.
TEST(Export, NominalUrCalibrationIsTheOneOfUrDescription) {
  const auto exported = ExportUrCalibration(Example("ur10.yaml"), nullptr);
  ASSERT_TRUE(exported.ok()) << exported.status();
  const auto origins = formats::JointOriginsOf(exported->nominal.geometry());
  ASSERT_TRUE(origins.ok()) << origins.status();
  const double right = std::numbers::pi / 2;
  const std::vector<formats::JointOrigin> expected = {
      {0, 0, .1273, 0, 0, 0},        {0, 0, 0, right, 0, 0},      {-.612, 0, 0, 0, 0, 0},
      {-.5723, 0, .163941, 0, 0, 0}, {0, -.1157, 0, right, 0, 0}, {0, .0922, 0, -right, 0, 0}};
  for (size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(i);
    // Rounding of sums of these lengths.
    EXPECT_NEAR((*origins)[i].x, expected[i].x, 1e-14);
    EXPECT_NEAR((*origins)[i].y, expected[i].y, 1e-14);
    EXPECT_NEAR((*origins)[i].z, expected[i].z, 1e-14);
    EXPECT_NEAR((*origins)[i].roll, expected[i].roll, 1e-14);
    EXPECT_NEAR((*origins)[i].pitch, expected[i].pitch, 1e-14);
    EXPECT_NEAR((*origins)[i].yaw, expected[i].yaw, 1e-14);
  }
}

// An identified robot's frames stay beside the nominal ones: would catch origins that run away with
// nearly parallel axes.
TEST(Export, UrCalibrationStaysNearNominal) {
  const v1::Nominal ur10 = Example("ur10.yaml");
  const v1::Calibration calibration = Truth(ur10);
  const auto nominal =
      formats::JointOriginsOf(ExportUrCalibration(ur10, nullptr)->nominal.geometry());
  const auto identified =
      formats::JointOriginsOf(ExportUrCalibration(ur10, &calibration)->nominal.geometry());
  for (size_t i = 0; i < nominal->size(); ++i) {
    const auto &a = (*nominal)[i], &b = (*identified)[i];
    EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.01);
    EXPECT_LT(std::hypot(a.roll - b.roll, a.pitch - b.pitch, a.yaw - b.yaw), 0.01);
  }
}

TEST(Export, UrCalibrationIsForUrRobotsOnly) {
  for (const char* other : {"franka_panda.yaml", "stanford.yaml", "measuring_robot.yaml"}) {
    const auto exported = ExportUrCalibration(Example(other), nullptr);
    ASSERT_EQ(FaultsOf(exported.status()).size(), 1u) << other;
    EXPECT_EQ(FaultsOf(exported.status())[0].field, "robot");
  }
  v1::Nominal turned = Example("ur10.yaml");
  turned.mutable_geometry()->mutable_standard_dh()->mutable_rows(1)->set_theta_rad(0.1);
  EXPECT_FALSE(ExportUrCalibration(turned, nullptr).ok());
  v1::Nominal flanged = Example("ur10.yaml");
  v1::ElementaryTransform* more = flanged.mutable_geometry()->add_flange();
  more->set_motion(v1::ElementaryTransform::ROTATION);
  more->set_axis(v1::X);
  more->set_constant(0.2);
  EXPECT_FALSE(ExportUrCalibration(flanged, nullptr).ok());
}

// The driver tells calibrations apart by it.
TEST(Export, UrHashTellsCalibrationsApart) {
  const v1::Nominal ur10 = Example("ur10.yaml");
  const v1::Calibration a = Truth(ur10, 4), b = Truth(ur10, 5);
  EXPECT_NE(UrHash(ur10, &a), UrHash(ur10, &b));
  EXPECT_NE(UrHash(ur10, &a), UrHash(ur10, nullptr));
  EXPECT_EQ(UrHash(ur10, &a), UrHash(ur10, &a));
  EXPECT_THAT(UrHash(ur10, &a), ::testing::MatchesRegex("calib_[0-9]+"));
}

// Would catch a way around the verdict.
TEST(Export, WhatMustNotBeAppliedIsNotExported) {
  const v1::Nominal ur10 = Example("ur10.yaml");
  v1::Calibration calibration = Truth(ur10);
  calibration.mutable_report()->set_verdict("do_not_apply");
  EXPECT_EQ(ExportJointFrames(ur10, &calibration).status().code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ExportDhTable(ur10, &calibration).status().code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ExportRobot(ur10, &calibration).status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ExportUrCalibration(ur10, &calibration).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace truepose::convert
