#include "client/service_config.h"

#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace truepose::client {
namespace {

// Every unary call: what changes something carries a request id (client.h). Streams go on where
// they broke off, which takes more than a repeat.
struct Repeatable {
  const char* service;
  std::vector<const char*> methods;  // none = all
};

const std::vector<Repeatable>& RepeatableCalls() {
  static const auto& calls = *new std::vector<Repeatable>{
      {"truepose.v1.RobotService", {}},
      {"truepose.v1.PlantService", {}},
      {"truepose.v1.SessionService",
       {"CreateSession", "GetSession", "ListSessions", "SealSession", "ListReadings",
        "UpdateSession", "DeleteSession", "UndeleteSession"}},
      {"truepose.v1.CalibrationService",
       {"CreateCalibrationJob", "GetCalibrationJob", "ListCalibrationJobs", "CancelCalibrationJob",
        "GetCalibration", "ListCalibrations", "ApproveCalibration", "RejectCalibration",
        "ActivateCalibration", "RollBackCalibration", "Evaluate", "Compensate",
        "CompareCalibrations"}},
      {"truepose.v1.CompensationTableService", {}},
      {"truepose.v1.RecalibrationService", {}},
      // The secret of Bootstrap is used up by the first call.
      {"truepose.v1.AdminService", {"CreateToken", "ListTokens", "RevokeToken", "GetServerStatus"}},
  };
  return calls;
}

constexpr char kRetryPolicy[] =
    R"({"maxAttempts":4,"initialBackoff":"0.1s","maxBackoff":"1s","backoffMultiplier":2,)"
    R"("retryableStatusCodes":["UNAVAILABLE"]})";

}  // namespace

std::string ServiceConfigJson() {
  std::vector<std::string> names;
  for (const Repeatable& calls : RepeatableCalls()) {
    if (calls.methods.empty()) {
      names.push_back(absl::StrCat(R"({"service":")", calls.service, R"("})"));
    }
    for (const char* method : calls.methods) {
      names.push_back(
          absl::StrCat(R"({"service":")", calls.service, R"(","method":")", method, R"("})"));
    }
  }
  return absl::StrCat(R"({"methodConfig":[{"name":[)", absl::StrJoin(names, ","),
                      R"(],"retryPolicy":)", kRetryPolicy, "}]}");
}

}  // namespace truepose::client
