#include "tests/server/testing/examples.h"

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "tests/server/testing/text_proto.h"

namespace truepose::testing {
namespace {

v1::Reading ExampleReading(int row) {
  v1::Reading reading;
  reading.set_row(row);
  for (int joint = 0; joint < 6; ++joint) reading.add_joints_measured(0.1 * joint + 0.001 * row);
  reading.mutable_position_m()->set_x(0.5 + 0.001 * row);
  reading.mutable_position_m()->set_y(0.25);
  reading.mutable_position_m()->set_z(1.0);
  return reading;
}

}  // namespace

v1::Nominal SixAxes(const std::string& serial) {
  auto nominal = Parse<v1::Nominal>(R"pb(
    manufacturer: "Example"
    model: "Six"
    kind: INDUSTRIAL
    geometry {
      standard_dh {
        rows { d_m: 0.1273 alpha_rad: 1.5707963267948966 }
        rows { a_m: -0.612 }
        rows { a_m: -0.5723 }
        rows { d_m: 0.1639 alpha_rad: 1.5707963267948966 }
        rows { d_m: 0.1157 alpha_rad: -1.5707963267948966 }
        rows { d_m: 0.0922 }
      }
    })pb");
  nominal.set_serial(serial);
  for (int i = 1; i <= 6; ++i) {
    v1::Joint& joint = *nominal.add_joints();
    joint.set_name(absl::StrCat("joint_", i));
    joint.set_type(v1::REVOLUTE);
    joint.set_lower(-6.28);
    joint.set_upper(6.28);
  }
  return nominal;
}

v1::CreateRobotRequest RobotRequest(const std::string& robot_id, const std::string& serial) {
  v1::CreateRobotRequest request;
  request.set_robot_id(robot_id);
  *request.mutable_nominal() = SixAxes(serial);
  return request;
}

v1::CreateSessionRequest SessionRequest(const std::string& session_id, const std::string& robot) {
  v1::CreateSessionRequest request;
  request.set_session_id(session_id);
  request.mutable_session()->set_robot(robot);
  request.mutable_session()->set_display_name("first measurement");
  return request;
}

v1::SessionInput SimulatedSession(int poses, unsigned seed) {
  convert::SimulationOptions options;
  options.poses = poses;
  options.seed = seed;
  const auto simulation = convert::RunSimulation(SixAxes(), options);
  EXPECT_TRUE(simulation.ok()) << simulation.status();
  return simulation.ok() ? simulation->session : v1::SessionInput();
}

v1::AppendReadingsRequest Batch(const std::string& session_id, int first, int count) {
  v1::AppendReadingsRequest request;
  request.set_session(absl::StrCat("sessions/", session_id));
  for (int row = first; row < first + count; ++row) *request.add_readings() = ExampleReading(row);
  return request;
}

}  // namespace truepose::testing
