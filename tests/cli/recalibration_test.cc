// recalibration, policy, robot-event and drift against a server in this process.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>

#include "absl/strings/str_cat.h"
#include "server/calibration_runner.h"
#include "server/server.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

constexpr char kUuid[] = "11111111-2222-4333-8444-555555555555";
constexpr char kCalibration[] = "robots/ur10/calibrations/1";

class RecalibrationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server::ServerOptions options;
    options.listen = absl::StrCat("unix:", folder_.Path("socket"));
    options.database = ":memory:";
    options.dev_open = true;
    auto started = server::Server::Start(options, server::CalibrationRunner());
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
    const std::string robot = Example("ur10.yaml"), session = folder_.Path("session.csv");
    ASSERT_EQ(RunCli({"simulate", robot, "--poses", "40", "--seed", "5", "--output", session}).code,
              0);
    Good({"robot", "add", robot});
    Good({"session", "import", session, "--robot", "ur10", "--session-id", kUuid});
    Good({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "even-odd"});
    Activate();
  }

  void Activate() {
    const auto stub = v1::CalibrationService::NewStub(
        grpc::CreateChannel(server_->address(), grpc::InsecureChannelCredentials()));
    v1::Calibration reply;
    v1::ApproveCalibrationRequest approve;
    approve.set_name(kCalibration);
    approve.set_reason("looked at");
    grpc::ClientContext first, second;
    ASSERT_TRUE(stub->ApproveCalibration(&first, approve, &reply).ok());
    v1::ActivateCalibrationRequest activate;
    activate.set_name(kCalibration);
    ASSERT_TRUE(stub->ActivateCalibration(&second, activate, &reply).ok());
  }

  Ran Remote(std::vector<std::string> line) const {
    line.insert(line.end(), {"--server", server_->address()});
    return RunCli(line);
  }
  std::string Good(const std::vector<std::string>& line) const {
    const Ran ran = Remote(line);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  }
  std::string Json(std::vector<std::string> line, const std::string& path) const {
    line.push_back("--json");
    return At(OneObject(Good(line)), path);
  }

  const TempFolder folder_;
  std::unique_ptr<server::Server> server_;
};

// A person's way from the bump to the new calibration: would catch a step that doesn't name the
// next, or a robot's name that doesn't find its open request.
TEST_F(RecalibrationTest, EachStepNamesTheNext) {
  EXPECT_THAT(Good({"recalibration", "list"}), HasSubstr("Next: truepose recalibration request"));
  EXPECT_THAT(Good({"recalibration", "request", "ur10", "--reason", "a bump"}),
              HasSubstr("Next: truepose recalibration acknowledge ur10"));
  EXPECT_THAT(Good({"recalibration", "acknowledge", "ur10"}),
              HasSubstr("Next: truepose recalibration measuring ur10"));
  EXPECT_THAT(Good({"recalibration", "measuring", "ur10", "--session", kUuid, "--readings", "40"}),
              HasSubstr("truepose recalibration calibrate ur10"));
  const std::string job = Json({"recalibration", "calibrate", "ur10"}, "job");
  Good({"job", "watch", job});
  EXPECT_EQ(Json({"recalibration", "list", "--robot", "ur10"}, "recalibration_requests.0.state"),
            "REQUEST_DONE");
  EXPECT_THAT(Good({"recalibration", "list"}), HasSubstr("a bump"));
}

// Would catch a wrong step or a missing request that ends well, or with another code.
TEST_F(RecalibrationTest, RefusalsTellTheShellAndThePerson) {
  EXPECT_EQ(Remote({"recalibration", "acknowledge", "ur10"}).code, 6);
  Good({"recalibration", "request", "ur10"});
  const Ran early = Remote({"recalibration", "calibrate", "ur10"});
  EXPECT_EQ(early.code, 1);
  EXPECT_THAT(early.err, HasSubstr("may follow pending: acknowledged"));
  EXPECT_EQ(Remote({"recalibration", "decline", "ur10"}).code, 2) << "a reason is needed";
  EXPECT_EQ(Json({"recalibration", "decline", "ur10", "--reason", "no time"}, "state"),
            "REQUEST_DECLINED");
}

// Would catch options that don't reach the policy, and `set` that fails on one that is there.
TEST_F(RecalibrationTest, PoliciesAreSetAndReplaced) {
  EXPECT_EQ(Json({"policy", "set", "ur10", "--interval-days", "1.5", "--event", "collision",
                  "--event", "motor-change", "--temperature-step", "4"},
                 "interval"),
            "129600s");
  EXPECT_THAT(Good({"policy", "list"}), HasSubstr("collision, motor_change"));
  EXPECT_EQ(Remote({"policy", "set", "ur10", "--event", "rain"}).code, 3);
  Good({"policy", "delete", "ur10"});
  EXPECT_THAT(Good({"policy", "list"}), HasSubstr("No policies"));
  EXPECT_EQ(Json({"policy", "set", "ur10", "--on-failed-check"}, "on_failed_check"), "true");
  EXPECT_EQ(Json({"policy", "list"}, "recalibration_policies.0.temperature_step_k"), "0");
}

// Would catch an event that isn't told to the policies, and one whose time or kind is lost.
TEST_F(RecalibrationTest, EventsAreReported) {
  Good({"policy", "set", "ur10", "--event", "collision"});
  EXPECT_EQ(Json({"robot-event", "add", "ur10", "temperature", "--temperature", "27.5", "--time",
                  "2026-01-02T03:04:05Z"},
                 "event_time"),
            "2026-01-02T03:04:05Z");
  EXPECT_EQ(Remote({"robot-event", "add", "ur10", "flood"}).code, 3);
  EXPECT_EQ(Remote({"robot-event", "add", "ur10", "temperature", "--temperature", "hot"}).code, 3);
  EXPECT_THAT(Good({"robot-event", "add", "ur10", "collision", "--description", "the fixture"}),
              HasSubstr("truepose recalibration list --robot ur10"));
  EXPECT_EQ(Json({"recalibration", "list"}, "recalibration_requests.0.reason"),
            "COLLISION: the fixture");
  EXPECT_THAT(Good({"robot-event", "list", "--robot", "ur10"}), HasSubstr("27.5"));
}

// Would catch figures that don't reach the person who asked.
TEST_F(RecalibrationTest, ADriftCheckIsShown) {
  EXPECT_THAT(Good({"drift", "list"}), HasSubstr("No checks"));
  const std::string text = Good({"drift", "check", "ur10", kUuid});
  EXPECT_THAT(text, HasSubstr("Drift check of ur10#1 with 40 poses: no change found"));
  EXPECT_THAT(text, HasSubstr("position RMS"));
  EXPECT_EQ(Json({"drift", "list"}, "drift_checks.0.changed"), "false");
  EXPECT_EQ(Remote({"drift", "check", "ur10", "11111111-2222-4333-8444-000000000000"}).code, 6);
}

}  // namespace
}  // namespace truepose::cli
