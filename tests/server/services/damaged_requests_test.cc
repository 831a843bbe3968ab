// Requests with damaged bytes, as a faulty client or an attacker sends them: no handler crashes,
// and none calls it its own fault.
#include <random>

#include "server/services/calibrations.h"
#include "server/services/jobs.h"
#include "server/services/robots.h"
#include "server/services/sessions.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::HandlerTest;
using testing::kJob1;
using testing::kJob2;
using testing::kSession1;
using testing::kSession2;
using testing::Parse;

class DamagedRequestsTest : public HandlerTest {
 protected:
  DamagedRequestsTest() {
    AddRobot("ur10");
    AddSimulatedSession(kSession1, "ur10", 20);
    AddCalibration("ur10", kSession1, kJob1);
    AddSession(kSession2, "ur10", 2);
  }

  // One to four bytes changed, removed or doubled.
  std::string Damage(std::string bytes) {
    for (size_t i = 0, count = 1 + random_() % 4; i < count && !bytes.empty(); ++i) {
      const size_t at = random_() % bytes.size();
      switch (random_() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random_());
          break;
        case 1:
          bytes[at] ^= static_cast<char>(1 << random_() % 8);
          break;
        case 2:
          bytes.erase(at, 1);
          break;
        default:
          bytes.insert(at, 1, bytes[at]);
      }
    }
    return bytes;
  }

  // Calls `handle` with damaged copies of `request` that still are messages.
  template <typename Request, typename Handle>
  void Try(const Request& request, const Handle& handle) {
    int parsed = 0;
    for (int i = 0; i < 1500; ++i) {
      Request damaged;
      if (!damaged.ParseFromString(Damage(request.SerializeAsString()))) continue;
      ++parsed;
      const absl::Status status = testing::StatusOf(handle(damaged));
      EXPECT_FALSE(absl::IsInternal(status) || absl::IsUnknown(status) || absl::IsDataLoss(status))
          << status << "\n"
          << damaged.DebugString();
    }
    EXPECT_GT(parsed, 100) << "hardly any damaged request was a message";
  }

 private:
  std::mt19937_64 random_{7};
};

TEST_F(DamagedRequestsTest, CreateRobot) {
  Try(testing::RobotRequest("ur10", "2"),
      [&](const auto& request) { return CreateRobot(call(), request); });
}

TEST_F(DamagedRequestsTest, CreateSession) {
  Try(testing::SessionRequest("00000000-0000-4000-8000-000000000003", "robots/ur10"),
      [&](const auto& request) { return CreateSession(call(), request); });
}

TEST_F(DamagedRequestsTest, AppendReadings) {
  Try(testing::Batch(kSession2, 2, 3), [&](const auto& request) { return Append(request); });
}

TEST_F(DamagedRequestsTest, AppendReadingsOfASource) {
  auto batch = testing::Batch(kSession2, 2, 3);
  batch.set_source("00000000-0000-4000-8000-0000000000aa");
  batch.set_first_sequence(1);
  Try(batch, [&](const auto& request) { return Append(request); });
}

TEST_F(DamagedRequestsTest, CreateCalibrationJob) {
  auto request = Parse<v1::CreateCalibrationJobRequest>(
      R"pb(robot: "robots/ur10"
           options { split: "random:7:0.5" group_column: "group" observe: POINT })pb");
  request.set_job_id(kJob2);
  request.add_sessions(std::string("sessions/") + kSession1);
  Try(request, [&](const auto& damaged) { return CreateCalibrationJob(call(), damaged); });
}

TEST_F(DamagedRequestsTest, Evaluate) {
  auto request = Parse<v1::EvaluateRequest>(R"pb(calibration: "robots/ur10/calibrations/1"
                                                 observe: POINT)pb");
  request.set_session(std::string("sessions/") + kSession1);
  Try(request, [&](const auto& damaged) { return Evaluate(call(), damaged); });
}

TEST_F(DamagedRequestsTest, Compensate) {
  const auto request = Parse<v1::CompensateRequest>(R"pb(
    calibration: "robots/ur10/calibrations/1"
    targets { row: 0 joints: 0.1 joints: -1.2 joints: 1.3 joints: 0.4 joints: 0.9 joints: 0.2 }
    targets {
      row: 1
      joints: 0.1
      joints: -1.2
      joints: 1.3
      joints: 0.4
      joints: 0.9
      joints: 0.2
      pose { x_m: 0.6 y_m: 0.2 z_m: 0.5 qw: 1 }
    })pb");
  Try(request, [&](const auto& damaged) { return Compensate(call(), damaged); });
}

TEST_F(DamagedRequestsTest, Lists) {
  const auto first = ListReadings(
      call(), Parse<v1::ListReadingsRequest>(
                  std::string(R"pb(page_size: 3 session: "sessions/)pb") + kSession1 + "\""));
  ASSERT_THAT(first, testing::IsOk());
  v1::ListReadingsRequest request;
  request.set_session(std::string("sessions/") + kSession1);
  request.set_page_size(3);
  request.set_page_token(first->next_page_token());
  Try(request, [&](const auto& damaged) { return ListReadings(call(), damaged); });
}

}  // namespace
}  // namespace truepose::services
