// A recalibration request from its raising to the new calibration, through truepose-agent, which is
// killed after every step.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "absl/strings/str_cat.h"
#include "client/wait_for_job.h"
#include "tests/agent/testing/agent_process.h"
#include "tests/agent/testing/line_client.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using nlohmann::json;
using testing::AgentProcess;
using testing::IsOk;
using testing::LineClient;
using testing::Uuid;

constexpr int kReadings = 150;

class AgentRequestTest : public testing::ServerFixture {
 protected:
  AgentRequestTest() : client_(NewClient()) {
    testing::Import(client_, "arm", Uuid(1), testing::MeasuringSession(200, 1));
    EXPECT_THAT(client_.CreateCalibrationJob(testing::JobRequest(Uuid(7), "arm", Uuid(1))), IsOk());
    EXPECT_THAT(client::WaitForJob(client_, "jobs/" + Uuid(7)), IsOk());
    v1::ApproveCalibrationRequest approve;
    approve.set_name("robots/arm/calibrations/1");
    approve.set_reason("looked at");
    EXPECT_THAT(client_.ApproveCalibration(approve), IsOk());
    v1::ActivateCalibrationRequest activate;
    activate.set_name("robots/arm/calibrations/1");
    EXPECT_THAT(client_.ActivateCalibration(activate), IsOk());
    StartAgent();
  }

  void StartAgent() {
    agent_.reset();
    agent_ = std::make_unique<AgentProcess>(
        folder_, absl::StrCat("agent = \"cell\"\nserver = \"", options_.listen, "\"\nspool = \"",
                              folder_.File("spool"), "\"\nlisten = \"127.0.0.1:0\"\n",
                              "[[robot]]\nname = \"arm\"\njoints = 5\n"));
    ASSERT_TRUE(agent_->WaitUntilReady()) << agent_->Output();
    lines_.emplace(agent_->address());
  }
  void KillAndStartAgent() {
    agent_->Kill();
    StartAgent();
  }

  v1::RecalibrationRequest Ask() {
    v1::CreateRecalibrationRequestRequest request;
    request.set_parent("robots/arm");
    request.set_recalibration_request_id(Uuid(9));
    request.mutable_recalibration_request()->set_reason("it hit the fixture");
    const auto asked = client_.CreateRecalibrationRequest(request);
    EXPECT_THAT(asked, IsOk());
    return *asked;
  }
  v1::RecalibrationRequest Now() const {
    v1::GetRecalibrationRequestRequest request;
    request.set_name(absl::StrCat("robots/arm/recalibrationRequests/", Uuid(9)));
    return client_.GetRecalibrationRequest(request).value_or(v1::RecalibrationRequest());
  }
  bool WaitFor(const std::function<bool(const v1::RecalibrationRequest&)>& condition) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition(Now())) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }
  bool WaitForState(v1::RecalibrationState state) const {
    return WaitFor([&](const auto& request) { return request.state() == state; });
  }
  // Until the agent answers it with ok; the poses come a moment after the request.
  json AskUntilOk(const json& message) {
    while (true) {
      const auto answer = lines_->Ask(message);
      if (!answer.has_value()) return json::object();
      if (answer->at("ok") && (!answer->contains("poses") || !answer->at("poses").empty()))
        return *answer;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  void Send(const v1::SessionInput& input, int first, int last) {
    for (int number = first; number <= last; ++number) {
      const v1::Reading& reading = input.readings(number - 1);
      json joints = json::array();
      for (const double joint : reading.joints_measured()) joints.push_back(joint);
      const v1::Vector3& p = reading.position_m();
      json message = {{"op", "reading"},
                      {"number", number},
                      {"joints", joints},
                      {"position_m", {p.x(), p.y(), p.z()}}};
      const v1::Quaternion& q = reading.orientation();
      if (reading.has_orientation()) message["quaternion"] = {q.x(), q.y(), q.z(), q.w()};
      const auto answer = lines_->Ask(message);
      ASSERT_TRUE(answer.has_value() && answer->at("ok")) << *answer;
    }
  }

  testing::TempDir folder_;
  const client::Client client_;
  std::unique_ptr<AgentProcess> agent_;
  std::optional<LineClient> lines_;
};

// Would catch a step that is lost with the agent, made twice, or waits for one that nobody makes.
TEST_F(AgentRequestTest, FromTheRequestToTheCalibrationThroughKills) {
  const json show = {{"op", "request"}, {"robot", "arm"}};
  const json begin = {{"op", "begin"}, {"robot", "arm"}, {"request", true}};
  Ask();
  ASSERT_TRUE(WaitForState(v1::REQUEST_ACKNOWLEDGED)) << agent_->Output();
  const json shown = AskUntilOk(show);
  EXPECT_EQ(shown.at("reason"), "it hit the fixture");
  EXPECT_EQ(shown.at("poses").size(), 20u);
  EXPECT_EQ(shown.at("poses")[0].at("joints").size(), 5u);
  EXPECT_TRUE(std::filesystem::exists(folder_.File("spool/requests/arm.json")));
  KillAndStartAgent();
  EXPECT_EQ(AskUntilOk(show).at("poses"), shown.at("poses"));
  const json begun = AskUntilOk(begin);
  const v1::SessionInput input = testing::MeasuringSession(kReadings, 1);
  Send(input, 1, 10);
  ASSERT_TRUE(WaitForState(v1::REQUEST_MEASURING)) << agent_->Output();
  KillAndStartAgent();
  const json again = AskUntilOk(begin);
  EXPECT_EQ(again.at("session"), begun.at("session"));
  EXPECT_EQ(again.at("readings"), 10);
  Send(input, 11, kReadings);
  ASSERT_TRUE(WaitFor([](const auto& request) { return request.readings_taken() == kReadings; }));
  EXPECT_TRUE(AskUntilOk({{"op", "seal"}, {"readings", kReadings}}).at("sealed"));
  agent_->Kill();
  StartAgent();
  ASSERT_TRUE(WaitForState(v1::REQUEST_DONE)) << agent_->Output() << Now().DebugString();
  EXPECT_EQ(Now().session(), begun.at("session"));
  EXPECT_EQ(Now().calibration(), "robots/arm/calibrations/2");
}

// Would catch a no that is forgotten when the agent dies before the server has heard it.
TEST_F(AgentRequestTest, APersonDeclines) {
  Ask();
  AskUntilOk({{"op", "request"}, {"robot", "arm"}});
  StopServer();
  EXPECT_TRUE(
      (*lines_->Ask({{"op", "decline"}, {"robot", "arm"}, {"reason", "replaced"}})).at("ok"));
  KillAndStartAgent();
  Restart();
  ASSERT_TRUE(WaitForState(v1::REQUEST_DECLINED)) << agent_->Output();
  EXPECT_EQ(Now().steps(Now().steps_size() - 1).reason(), "replaced");
  EXPECT_FALSE((*lines_->Ask({{"op", "request"}, {"robot", "arm"}})).at("ok"));
}

}  // namespace
}  // namespace truepose
