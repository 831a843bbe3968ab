// The harness of handlers: a store in memory, an engine whose runner the test decides, no
// transport.
#pragma once

#include <memory>
#include <string>

#include "gtest/gtest.h"
#include "server/jobs/engine.h"
#include "server/services/append.h"
#include "server/services/call_context.h"
#include "server/store/store.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/text_proto.h"

namespace truepose::testing {

// One message of an upload, and its acknowledgement.
absl::StatusOr<v1::AppendReadingsResponse> AppendAndWait(services::AppendStream& stream,
                                                         const v1::AppendReadingsRequest& request);

class HandlerTest : public ::testing::Test {
 protected:
  // `clock` of store and engine; nullptr = the system's.
  explicit HandlerTest(const store::Clock* clock = nullptr);

  const services::CallContext& call() const { return *call_; }
  store::Store& store() { return *store_; }
  jobs::JobEngine& engine() { return *engine_; }

  // One message in a stream of its own.
  absl::StatusOr<v1::AppendReadingsResponse> Append(const v1::AppendReadingsRequest& request) const;

  // Through the handlers; a failure fails the test.
  void AddRobot(const std::string& robot_id);
  void AddSession(const std::string& session_id, const std::string& robot_id, int readings);
  void AddSealedSession(const std::string& session_id, const std::string& robot_id,
                        int readings = 3);
  // Readings that a slightly wrong six-axis robot would give.
  void AddSimulatedSession(const std::string& session_id, const std::string& robot_id, int poses);
  // The same for a session that is there and empty.
  void AddReadingsAndSeal(const std::string& session_id, int poses);
  // A real calibration over kCalibrationPoses rows, stored as that of `robot_id` from a sealed
  // session, as the engine would.
  v1::Calibration AddCalibration(const std::string& robot_id, const std::string& session_id,
                                 const std::string& job_id);

 private:
  void CloseSession(const std::string& session_id, int readings);

  std::unique_ptr<store::Store> store_;
  std::unique_ptr<jobs::JobEngine> engine_;  // not started: jobs stay PENDING
  std::unique_ptr<services::CallContext> call_;
};

}  // namespace truepose::testing
