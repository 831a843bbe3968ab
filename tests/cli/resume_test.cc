// Imports that were cut off: what another run finds, and what it does with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "absl/strings/str_cat.h"
#include "client/append_readings.h"
#include "client/client.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "server/calibration_runner.h"
#include "server/server.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

constexpr char kUuid[] = "11111111-2222-4333-8444-555555555555";

class ResumeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server::ServerOptions options;
    options.dev_open = true;
    options.listen = absl::StrCat("unix:", folder_.Path("socket"));
    options.database = ":memory:";
    auto started = server::Server::Start(options, server::CalibrationRunner());
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
    ASSERT_EQ(RunCli({"simulate", robot_, "--poses", "40", "--output", session_}).code, 0);
    ASSERT_EQ(RunCli({"robot", "add", robot_, "--server", server_->address()}).code, 0);
  }

  // What an import leaves that ended after `count` readings; `shift_m` makes them those of another
  // file.
  void LeaveOpen(int count, double shift_m) const {
    const auto client = client::Client::Connect(server_->address());
    ASSERT_TRUE(client.ok());
    auto file = formats::ReadSessionFile(session_, formats::ReadRobotFile(robot_)->nominal);
    ASSERT_TRUE(file.ok()) << file.status();
    file->session.set_robot("robots/ur10");
    file->session.set_display_name("session.csv");
    v1::CreateSessionRequest request;
    request.set_session_id(kUuid);
    *request.mutable_session() = file->session;
    const auto created = client->CreateSession(request);
    ASSERT_TRUE(created.ok()) << created.status();
    file->readings.resize(count);
    for (v1::Reading& reading : file->readings) {
      reading.mutable_position_m()->set_x(reading.position_m().x() + shift_m);
    }
    ASSERT_TRUE(client::AppendReadings(*client, created->name(), file->readings).ok());
  }

  Ran Import() const {
    return RunCli({"session", "import", session_, "--robot", "ur10", "--session-id", kUuid,
                   "--server", server_->address()});
  }
  google::protobuf::Struct Session() const {
    return OneObject(
        RunCli({"session", "show", kUuid, "--json", "--server", server_->address()}).out);
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml");
  const std::string session_ = folder_.Path("session.csv");
  std::unique_ptr<server::Server> server_;
};

// Would catch an import that starts over, doubles rows, or can't go on.
TEST_F(ResumeTest, TheSameFileGoesOn) {
  LeaveOpen(15, 0.0);
  EXPECT_EQ(At(Session(), "state"), "OPEN");
  const Ran ran = Import();
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(At(Session(), "state"), "SEALED");
  EXPECT_EQ(At(Session(), "reading_count"), "40");
}

// Would catch a session put together from two files, or a failure that does not say what is left
// and how to go on.
TEST_F(ResumeTest, AnotherFileIsNotMixedIn) {
  LeaveOpen(15, 0.001);
  const Ran ran = Import();
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr(absl::StrCat("Session ", kUuid, " stays open")));
  EXPECT_EQ(At(Session(), "state"), "OPEN");
  EXPECT_EQ(At(Session(), "reading_count"), "15");
}

// Would catch an open session taken for a whole one.
TEST_F(ResumeTest, AnOpenSessionIsNotCalibrated) {
  LeaveOpen(40, 0.0);
  const Ran ran =
      RunCli({"calibrate", "--robot", "ur10", "--session", kUuid, "--server", server_->address()});
  EXPECT_NE(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr(kUuid));
}

}  // namespace
}  // namespace truepose::cli
