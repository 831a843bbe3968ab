#include "client/service_config.h"

#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace truepose::client {
namespace {

struct Idempotent {
  const char* service;
  std::vector<const char*> methods;
};

const std::vector<Idempotent>& IdempotentCalls() {
  static const auto& calls = *new std::vector<Idempotent>{
      {"truepose.v1.RobotService",
       {"CreateRobot", "GetRobot", "ListRobots", "GetNominalRevision", "ListNominalRevisions"}},
      {"truepose.v1.SessionService",
       {"CreateSession", "GetSession", "ListSessions", "SealSession", "ListReadings"}},
      {"truepose.v1.CalibrationService",
       {"CreateCalibrationJob", "GetCalibrationJob", "ListCalibrationJobs", "CancelCalibrationJob",
        "GetCalibration", "ListCalibrations", "Evaluate", "Compensate", "CompareCalibrations"}},
  };
  return calls;
}

constexpr char kRetryPolicy[] =
    R"({"maxAttempts":4,"initialBackoff":"0.1s","maxBackoff":"1s","backoffMultiplier":2,)"
    R"("retryableStatusCodes":["UNAVAILABLE"]})";

}  // namespace

std::string ServiceConfigJson() {
  std::vector<std::string> names;
  for (const Idempotent& calls : IdempotentCalls()) {
    for (const char* method : calls.methods) {
      names.push_back(
          absl::StrCat(R"({"service":")", calls.service, R"(","method":")", method, R"("})"));
    }
  }
  return absl::StrCat(R"({"methodConfig":[{"name":[)", absl::StrJoin(names, ","),
                      R"(],"retryPolicy":)", kRetryPolicy, "}]}");
}

}  // namespace truepose::client
