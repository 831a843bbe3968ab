// A server within the process that runs real calibrations, and what a client does with it.
#pragma once

#include <memory>
#include <string>

#include "client/client.h"
#include "convert/run.h"
#include "gtest/gtest.h"
#include "server/jobs/runner.h"
#include "server/server.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::testing {

// A simulated session of the measuring robot; the same seed gives the same errors of the robot.
v1::SessionInput MeasuringSession(int poses, unsigned seed);

// "00000000-0000-4000-8000-0000000000NN"
std::string Uuid(int number);

// Creates robot (the measuring robot), session, readings, and seals. A failure fails the test.
void Import(const client::Client& client, const std::string& robot_id,
            const std::string& session_id, const v1::SessionInput& input);

v1::CreateCalibrationJobRequest JobRequest(const std::string& job_id, const std::string& robot_id,
                                           const std::string& session_id);

// The file of a table for tests, in three pieces; it differs with calibration and seed.
absl::StatusOr<jobs::BuiltTable> SmallTable(const v1::CompensationTableInput& input,
                                            const jobs::RunnerHooks& hooks);

class ServerFixture : public ::testing::Test {
 protected:
  ServerFixture();

  // Stops the server if there is one and starts another on the same address and database.
  void Restart();
  void StopServer() { server_.reset(); }
  client::Client NewClient() const;

  server::ServerOptions options_;
  jobs::Runners runner_;  // of the next Restart; tables are SmallTable

 private:
  TempDir folder_;
  std::unique_ptr<server::Server> server_;
};

}  // namespace truepose::testing
