#include "client/cli/inputs.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/json.h"
#include "client/cli/outcome.h"
#include "client/cli/same_robot.h"
#include "convert/digest.h"
#include "convert/fixture.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/fixture_file.h"
#include "formats/text_file.h"

namespace truepose::cli {
namespace {

constexpr char kLocalPrefix[] = "sha256:";
// A calibration with the residuals of a million rows is about 200 MB of JSON.
constexpr size_t kMostCalibrationBytes = 1'000'000'000;

absl::StatusOr<v1::SessionInput> LoadSession(const std::string& path, const v1::Nominal& nominal,
                                             const formats::SessionFileOptions& options,
                                             const Console& console) {
  TRUEPOSE_ASSIGN_OR_RETURN(formats::SessionFile file,
                            formats::ReadSessionFile(path, nominal, options));
  for (const std::string& warning : file.warnings) Warn(console, warning);
  v1::SessionInput input;
  *input.mutable_session() = std::move(file.session);
  input.mutable_session()->set_name(path);
  input.mutable_session()->set_reading_count(static_cast<int>(file.readings.size()));
  for (v1::Reading& reading : file.readings) *input.add_readings() = std::move(reading);
  return input;
}

bool DigestFits(const v1::Calibration& calibration, const std::string& nominal_digest) {
  return calibration.digest() ==
         convert::CalibrationDigest(calibration.report().convention(), nominal_digest, calibration);
}

// "" of a revision that a server counts.
std::string DigestOfRevision(const std::string& revision) {
  const size_t at = revision.find(kLocalPrefix);
  return at == std::string::npos ? "" : revision.substr(at + std::string(kLocalPrefix).size());
}

// "" for a calibration of that nominal, unchanged. The digest covers the nominal; of which one it
// was made is known from the revision only where that is a digest itself.
std::string WhyForeign(const v1::Calibration& calibration, const v1::Nominal& nominal) {
  const std::string& made_from = calibration.nominal_revision();
  const std::string own = convert::NominalDigest(nominal), hex = DigestOfRevision(made_from);
  const std::string other = absl::StrCat("is of another nominal revision, ", made_from);
  if (calibration.digest().empty()) return hex == own ? "" : other;
  if (DigestFits(calibration, own)) return "";
  if (hex.empty()) return "was edited, or " + other;
  return DigestFits(calibration, hex) ? other : "was edited: its digest does not fit";
}

}  // namespace

absl::StatusOr<formats::RobotFile> LoadRobot(const std::string& path,
                                             const formats::UrdfEnds& ends) {
  absl::StatusOr<formats::RobotFile> file = formats::ReadRobotOrUrdfFile(path, ends);
  if (!file.ok()) return AsInputFault(file.status());
  TRUEPOSE_RETURN_IF_ERROR(
      formats::LocateFaults(convert::ValidateNominal(file->nominal), file->lines));
  return file;
}

absl::StatusOr<v1::Fixture> LoadFixture(const std::string& path) {
  absl::StatusOr<formats::FixtureFile> file = formats::ReadFixtureFile(path);
  if (!file.ok()) return AsInputFault(file.status());
  TRUEPOSE_RETURN_IF_ERROR(
      formats::LocateFaults(convert::ValidateFixture(file->fixture), file->lines));
  return std::move(file->fixture);
}

absl::Status CheckNoEnds(const formats::UrdfEnds& ends) {
  if (ends.empty()) return absl::OkStatus();
  return UsageError("--urdf-base and --urdf-tip are for robot files, with --local");
}

absl::StatusOr<std::vector<v1::SessionInput>> LoadSessions(
    const std::vector<std::string>& paths, const v1::Nominal& nominal,
    const formats::SessionFileOptions& options, const Console& console) {
  std::vector<v1::SessionInput> sessions;
  FaultList faults;
  for (const std::string& path : paths) {
    absl::StatusOr<v1::SessionInput> session = LoadSession(path, nominal, options, console);
    faults.AddAll(session.status());
    if (session.ok()) sessions.push_back(*std::move(session));
  }
  if (!faults.empty()) return faults.ToStatus();
  return sessions;
}

absl::Status CheckLimits(const v1::Nominal& nominal, const v1::SessionInput& session, bool strict,
                         const Console& console) {
  FaultList faults;
  const std::vector<v1::Reading> readings(session.readings().begin(), session.readings().end());
  for (const std::string& warning : convert::LimitWarnings(nominal, readings)) {
    if (strict)
      faults.Add(session.session().name(), warning, "joints within the limits of the robot file");
    if (!strict) Warn(console, absl::StrCat(session.session().name(), ": ", warning));
  }
  return faults.ToStatus();
}

absl::StatusOr<v1::Calibration> LoadCalibration(const std::string& path) {
  const absl::StatusOr<std::string> text = formats::ReadTextFile(path, kMostCalibrationBytes);
  if (!text.ok()) return AsInputFault(text.status());
  v1::Calibration calibration;
  TRUEPOSE_RETURN_IF_ERROR(FromJson(*text, path, &calibration));
  if (calibration.internal_parameters().empty()) {
    return FaultStatus(absl::StrCat(path, ": internal_parameters"), "none",
                       "a file that `truepose calibrate --output` wrote");
  }
  return calibration;
}

absl::StatusOr<v1::Observe> ParseObserve(const std::string& text) {
  if (text.empty()) return v1::OBSERVE_UNSPECIFIED;
  if (text == "pose") return v1::POSE;
  if (text == "point") return v1::POINT;
  if (text == "point_axis") return v1::POINT_AXIS;
  return OptionFault("--observe", text, "pose, point or point_axis");
}

std::string LocalRevision(const formats::RobotFile& robot) {
  const std::string name = NameOfRobot(robot);
  return absl::StrCat(name, name.empty() ? "" : "/nominals/", kLocalPrefix,
                      convert::NominalDigest(robot.nominal));
}

absl::Status CheckBelongsTogether(const v1::Calibration& calibration,
                                  const formats::RobotFile& robot, const std::string& robot_path) {
  const std::string why = WhyForeign(calibration, robot.nominal);
  if (why.empty()) return absl::OkStatus();
  return FaultStatus(
      "--robot",
      absl::StrCat(robot_path, " with nominal ", kLocalPrefix,
                   convert::NominalDigest(robot.nominal), " beside a calibration that ", why),
      "the robot file from which the calibration was made, and that calibration "
      "unchanged");
}

absl::StatusOr<LocalCalibration> LoadLocalCalibration(const std::string& robot_path,
                                                      const formats::UrdfEnds& ends,
                                                      const std::string& calibration_path) {
  if (robot_path.empty()) return UsageError("--local needs --robot FILE");
  TRUEPOSE_ASSIGN_OR_RETURN(formats::RobotFile robot, LoadRobot(robot_path, ends));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration calibration, LoadCalibration(calibration_path));
  TRUEPOSE_RETURN_IF_ERROR(CheckBelongsTogether(calibration, robot, robot_path));
  TRUEPOSE_RETURN_IF_ERROR(CheckSameRobot(
      {calibration_path, "a calibration", RobotOfCalibration(calibration)}, robot, robot_path));
  return LocalCalibration{std::move(robot), std::move(calibration)};
}

absl::Status CheckPrior(const v1::Calibration& calibration, const v1::Nominal& nominal) {
  const std::string why = WhyForeign(calibration, nominal);
  if (why.empty()) return absl::OkStatus();
  return FaultStatus(
      "--prior", "a calibration that " + why,
      "a calibration of this nominal robot, as `truepose calibrate --output` wrote it");
}

}  // namespace truepose::cli
