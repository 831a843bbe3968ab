#include "server/auth/access_table.h"

#include "absl/strings/str_cat.h"
#include "server/store/message.h"

namespace truepose::auth {
namespace {

using enum Access;

constexpr char kRobotService[] = "truepose.v1.RobotService";
constexpr char kSessionService[] = "truepose.v1.SessionService";
constexpr char kCalibrationService[] = "truepose.v1.CalibrationService";
constexpr char kPlantService[] = "truepose.v1.PlantService";
constexpr char kDownloadService[] = "truepose.v1.DownloadService";
constexpr char kWatchService[] = "truepose.v1.WatchService";
constexpr char kRecalibrationService[] = "truepose.v1.RecalibrationService";
constexpr char kCompensationTableService[] = "truepose.v1.CompensationTableService";
constexpr char kAdminService[] = "truepose.v1.AdminService";

constexpr AccessRow kTable[] = {
    {kRobotService, "CreateRobot", kToken},
    {kRobotService, "GetRobot", kToken},
    {kRobotService, "ListRobots", kToken},
    {kRobotService, "CreateNominalRevision", kToken},
    {kRobotService, "GetNominalRevision", kToken},
    {kRobotService, "ListNominalRevisions", kToken},
    {kRobotService, "UpdateRobot", kToken},
    {kRobotService, "DeleteRobot", kToken},
    {kRobotService, "UndeleteRobot", kToken},
    {kSessionService, "CreateSession", kToken},
    {kSessionService, "GetSession", kToken},
    {kSessionService, "ListSessions", kToken},
    {kSessionService, "AppendReadings", kToken},
    {kSessionService, "SealSession", kToken},
    {kSessionService, "ListReadings", kToken},
    {kSessionService, "UpdateSession", kToken},
    {kSessionService, "DeleteSession", kToken},
    {kSessionService, "UndeleteSession", kToken},
    {kCalibrationService, "CreateCalibrationJob", kToken},
    {kCalibrationService, "GetCalibrationJob", kToken},
    {kCalibrationService, "ListCalibrationJobs", kToken},
    {kCalibrationService, "CancelCalibrationJob", kToken},
    {kCalibrationService, "WatchCalibrationJob", kToken},
    {kCalibrationService, "GetCalibration", kToken},
    {kCalibrationService, "ListCalibrations", kToken},
    {kCalibrationService, "Evaluate", kToken},
    {kCalibrationService, "Compensate", kToken},
    {kCalibrationService, "ApproveCalibration", kPerson},
    {kCalibrationService, "RejectCalibration", kPerson},
    {kCalibrationService, "ActivateCalibration", kPerson},
    {kCalibrationService, "RollBackCalibration", kPerson},
    {kCalibrationService, "CompareCalibrations", kToken},
    {kPlantService, "CreateInstrument", kToken},
    {kPlantService, "GetInstrument", kToken},
    {kPlantService, "ListInstruments", kToken},
    {kPlantService, "UpdateInstrument", kToken},
    {kPlantService, "DeleteInstrument", kToken},
    {kPlantService, "UndeleteInstrument", kToken},
    {kPlantService, "CreateRegisteredTool", kToken},
    {kPlantService, "GetRegisteredTool", kToken},
    {kPlantService, "ListRegisteredTools", kToken},
    {kPlantService, "UpdateRegisteredTool", kToken},
    {kPlantService, "DeleteRegisteredTool", kToken},
    {kPlantService, "UndeleteRegisteredTool", kToken},
    {kPlantService, "CreateRegisteredFixture", kToken},
    {kPlantService, "GetRegisteredFixture", kToken},
    {kPlantService, "ListRegisteredFixtures", kToken},
    {kPlantService, "UpdateRegisteredFixture", kToken},
    {kPlantService, "DeleteRegisteredFixture", kToken},
    {kPlantService, "UndeleteRegisteredFixture", kToken},
    {kPlantService, "CreateTarget", kToken},
    {kPlantService, "GetTarget", kToken},
    {kPlantService, "ListTargets", kToken},
    {kPlantService, "UpdateTarget", kToken},
    {kPlantService, "DeleteTarget", kToken},
    {kPlantService, "UndeleteTarget", kToken},
    {kPlantService, "CreatePlacement", kToken},
    {kPlantService, "GetPlacement", kToken},
    {kPlantService, "ListPlacements", kToken},
    {kPlantService, "UpdatePlacement", kToken},
    {kPlantService, "DeletePlacement", kToken},
    {kPlantService, "UndeletePlacement", kToken},
    {kPlantService, "CreatePoseSet", kToken},
    {kPlantService, "GetPoseSet", kToken},
    {kPlantService, "ListPoseSets", kToken},
    {kPlantService, "UpdatePoseSet", kToken},
    {kPlantService, "DeletePoseSet", kToken},
    {kPlantService, "UndeletePoseSet", kToken},
    {kDownloadService, "Download", kToken},
    {kWatchService, "Watch", kToken},
    {kCompensationTableService, "CreateCompensationTable", kToken},
    {kCompensationTableService, "GetCompensationTable", kToken},
    {kCompensationTableService, "GetActiveCompensationTable", kToken},
    {kCompensationTableService, "ListCompensationTables", kToken},
    {kCompensationTableService, "DeleteCompensationTable", kToken},
    {kCompensationTableService, "UndeleteCompensationTable", kToken},
    {kRecalibrationService, "CreateRobotEvent", kToken},
    {kRecalibrationService, "GetRobotEvent", kToken},
    {kRecalibrationService, "ListRobotEvents", kToken},
    {kRecalibrationService, "CreateRecalibrationPolicy", kToken},
    {kRecalibrationService, "GetRecalibrationPolicy", kToken},
    {kRecalibrationService, "ListRecalibrationPolicies", kToken},
    {kRecalibrationService, "UpdateRecalibrationPolicy", kToken},
    {kRecalibrationService, "DeleteRecalibrationPolicy", kToken},
    {kRecalibrationService, "UndeleteRecalibrationPolicy", kToken},
    {kRecalibrationService, "CreateRecalibrationRequest", kToken},
    {kRecalibrationService, "GetRecalibrationRequest", kToken},
    {kRecalibrationService, "ListRecalibrationRequests", kToken},
    {kRecalibrationService, "CreateDriftCheck", kToken},
    {kRecalibrationService, "GetDriftCheck", kToken},
    {kRecalibrationService, "ListDriftChecks", kToken},
    {kRecalibrationService, "AcknowledgeRecalibration", kToken},
    {kRecalibrationService, "ReportMeasuring", kToken},
    {kRecalibrationService, "CalibrateForRequest", kToken},
    {kRecalibrationService, "DeclineRecalibration", kToken},
    {kRecalibrationService, "ReportAgent", kToken},
    {kRecalibrationService, "ListAgentReports", kToken},
    {kAdminService, "Bootstrap", kEverybody},
    {kAdminService, "CreateToken", kAdmin},
    {kAdminService, "ListTokens", kAdmin},
    {kAdminService, "RevokeToken", kAdmin},
    {kAdminService, "GetServerStatus", kToken},
};

absl::Status Denied(const std::string& found, const std::string& expected) {
  return store::Refusal(absl::StatusCode::kPermissionDenied, "authorization", found, expected);
}

}  // namespace

std::span<const AccessRow> AccessTable() { return kTable; }

std::optional<Access> AccessTo(std::string_view method) {
  std::optional<Access> access;
  for (const AccessRow& row : kTable) {
    if (row.method != method) continue;
    if (access.has_value()) return std::nullopt;
    access = row.access;
  }
  return access;
}

absl::Status CheckAccess(const std::optional<Access>& access, const Caller& caller) {
  if (!access.has_value()) return Denied("a call without a row in the table of access", "another");
  if (*access == kPerson && caller.is_machine) {
    return Denied(absl::StrCat("the token of ", caller.principal, ", which is a machine"),
                  "a person's token");
  }
  if (*access == kAdmin && !caller.is_admin) {
    return Denied(absl::StrCat("the token of ", caller.principal, ", who is no admin"),
                  "an admin's token: ask who made this one (`created_by`)");
  }
  return absl::OkStatus();
}

}  // namespace truepose::auth
