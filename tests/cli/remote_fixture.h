// Commands against a server in this process, on a unix socket of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "server/calibration_runner.h"
#include "server/server.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {

inline constexpr char kUuid[] = "11111111-2222-4333-8444-555555555555";
inline constexpr char kOtherUuid[] = "11111111-2222-4333-8444-666666666666";

class RemoteFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    StartServer();
    ASSERT_EQ(
        RunCli({"simulate", robot_, "--poses", "40", "--seed", "5", "--output", session_}).code, 0);
  }

  // Another server over the same database, on the same address.
  void StartServer() {
    server_.reset();
    server::ServerOptions options;
    options.dev_open = true;
    options.listen = absl::StrCat("unix:", folder_.Path("socket"));
    options.database = folder_.Path("plant.db");
    auto started = server::Server::Start(options, runners_);
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
  }

  Ran Remote(std::vector<std::string> line) const {
    line.insert(line.end(), {"--server", server_->address()});
    return RunCli(line);
  }
  // The same, and it has to succeed.
  Ran Demand(const std::vector<std::string>& line) const {
    const Ran ran = Remote(line);
    EXPECT_EQ(ran.code, 0) << line[0] << " " << line[1] << ": " << ran.err;
    return ran;
  }

  void AddRobot() const { Demand({"robot", "add", robot_}); }
  void Import() const {
    Demand({"session", "import", session_, "--robot", "ur10", "--session-id", kUuid});
  }
  void Calibrate() const {
    Demand({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "even-odd"});
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml");
  const std::string session_ = folder_.Path("session.csv");
  jobs::Runners runners_ = server::CalibrationRunner();
  std::unique_ptr<server::Server> server_;
};

}  // namespace truepose::cli
