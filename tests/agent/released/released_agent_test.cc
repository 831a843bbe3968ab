// A whole agent: from an activation to the controller that asks for joints, and to the server that
// hears what runs.
#include <cmath>

#include "client/agent/agent.h"
#include "compensation/kinematics.h"
#include "gmock/gmock.h"
#include "tests/agent/released/release_fixture.h"
#include "tests/agent/released/released_testing.h"
#include "tests/agent/testing/line_client.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::agent {
namespace {

using nlohmann::json;
using truepose::testing::IsOk;
using truepose::testing::LineClient;

class ReleasedAgentTest : public testing::ReleaseFixture {
 protected:
  void StartAgent() {
    AgentConfig config;
    config.agent = "cell";
    config.server = options_.listen;
    config.spool = folder_.File("spool");
    config.listen = "127.0.0.1:0";
    config.robots = {{.name = "robots/arm", .joints = 5}};  // of the measuring robot
    auto agent = Agent::Start(config, {});
    ASSERT_THAT(agent, IsOk());
    agent_ = *std::move(agent);
    lines_ = std::make_unique<LineClient>(agent_->address());
  }
  void TearDown() override {
    lines_.reset();
    agent_.reset();
  }
  json Ask(const json& message) { return lines_->Ask(message).value_or(json{{"ok", "no answer"}}); }
  bool WaitUntilRuns(int number) {
    return WaitUntil([&] {
      return Ask({{"op", "released"}, {"robot", "arm"}}).value("calibration", "") ==
             "robots/arm/calibrations/" + std::to_string(number);
    });
  }
  v1::AgentReport Report() const {
    v1::ListAgentReportsResponse reports;
    EXPECT_THAT(NewClient().CallMethod("truepose.v1.RecalibrationService/ListAgentReports",
                                       v1::ListAgentReportsRequest(), &reports),
                IsOk());
    return reports.agent_reports().empty() ? v1::AgentReport() : reports.agent_reports(0);
  }
  // Poses of a controller that runs the calibration of that number.
  static json PosesBy(int number) {
    const testing::TestTable table(number);
    json poses = json::array();
    for (int i = 0; i < 6; ++i) {
      compensation::JointArray q{};
      for (int joint = 0; joint < 6; ++joint) q[joint] = std::sin(1.0 + 7 * i + 3 * joint);
      const Pose X = compensation::IdentifiedFlange(table.content.arm, q.data());
      const Eigen::Vector3d vector = LogRotation<double>(X.R);
      poses.push_back({{"joints", std::vector<double>(q.begin(), q.begin() + 6)},
                       {"position_m", {X.p.x(), X.p.y(), X.p.z()}},
                       {"rotation_vector", {vector.x(), vector.y(), vector.z()}}});
    }
    return poses;
  }

  truepose::testing::TempDir folder_;
  std::unique_ptr<Agent> agent_;
  std::unique_ptr<LineClient> lines_;
};

// Would catch an agent that keeps its set for itself: no answer to the controller, no word to the
// server, or a read-back that nobody hears of.
TEST_F(ReleasedAgentTest, CorrectsReadsBackAndReports) {
  StartAgent();
  const json question = {
      {"op", "correct"}, {"robot", "arm"}, {"joints", {0.1, -1.2, 1.3, -1.6, -1.5, 0.2}}};
  EXPECT_EQ(Ask(question).at("code"), "FAILED_PRECONDITION");
  Activate(1);
  ASSERT_TRUE(WaitUntilRuns(1));
  Activate(2);
  ASSERT_TRUE(WaitUntilRuns(2));
  const json corrected = Ask(question);
  EXPECT_EQ(corrected.at("ok"), true) << corrected;
  EXPECT_EQ(corrected.at("calibration"), "robots/arm/calibrations/2");
  const json outside = Ask({{"op", "correct"}, {"robot", "arm"}, {"joints", {0, 3, 0, 0, 0, 0}}});
  EXPECT_EQ(outside.at("ok"), false) << outside;
  EXPECT_EQ(outside.at("outcome"), "outside_domain");

  const json back = Ask({{"op", "read_back"}, {"robot", "arm"}, {"poses", PosesBy(1)}});
  EXPECT_EQ(back.at("controller_state"), "older") << back;
  EXPECT_EQ(back.at("parameters"), "robots/arm/calibrations/1");
  EXPECT_TRUE(WaitUntil([&] { return Report().controller_state() == "older"; }));
  EXPECT_EQ(Report().calibration(), "robots/arm/calibrations/2");
  EXPECT_EQ(Report().digest().size(), 64U);
  EXPECT_EQ(Ask({{"op", "status"}}).at("robots")[0].at("released"), "robots/arm/calibrations/2");
}

// Would catch a robot that runs an older table, or none, since the server could not make the one of
// its active calibration, and nobody hears of it: not the status, the figures or the server.
TEST_F(ReleasedAgentTest, ATableThatFailedIsAProblem) {
  runner_.build_table = [](const v1::CompensationTableInput&,
                           const jobs::RunnerHooks&) -> absl::StatusOr<jobs::BuiltTable> {
    return absl::InternalError("no such table");
  };
  Restart();
  StartAgent();
  Activate(1);
  const auto problem = [&] {
    return Ask({{"op", "status"}}).at("robots")[0].value("released_problem", "");
  };
  ASSERT_TRUE(WaitUntil([&] { return !problem().empty(); }));
  EXPECT_THAT(problem(), ::testing::HasSubstr("calibrations/1 FAILED"));
  EXPECT_TRUE(WaitUntil([&] { return Report().message() == "released set: " + problem(); }))
      << Report().message();
  EXPECT_EQ(agent_->Status().robots[0].released_problem, problem());
}

// Would catch an agent whose controller stands still because the server does.
TEST_F(ReleasedAgentTest, CorrectsWithoutAServer) {
  StartAgent();
  Activate(1);
  ASSERT_TRUE(WaitUntilRuns(1));
  lines_.reset();
  agent_.reset();
  StopServer();
  StartAgent();
  ASSERT_TRUE(WaitUntilRuns(1));
  EXPECT_EQ(Ask({{"op", "correct"},
                 {"robot", "arm"},
                 {"joints", {0.1, -1.2, 1.3, -1.6, -1.5, 0.2}},
                 {"exact", true}})
                .at("ok"),
            true);
}

}  // namespace
}  // namespace truepose::agent
