#include "client/cli/commands/identification_options.h"

#include <filesystem>
#include <numbers>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/cli/inputs.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

absl::StatusOr<v1::Calibration> PriorCalibrationOf(const std::string& text,
                                                   const FetchCalibration& fetch) {
  std::error_code error;
  if (std::filesystem::is_regular_file(text, error) || !fetch) {
    absl::StatusOr<v1::Calibration> calibration = LoadCalibration(text);
    if (!calibration.ok()) return RenameFields(calibration.status(), {{"calibration", "--prior"}});
    return calibration;
  }
  return fetch(text);
}

absl::Status WritePrior(const std::string& text, const FetchCalibration& fetch,
                        const FetchNominal& nominal, v1::CalibrationOptions* message) {
  if (text.empty() || text == "none" || text == "tolerance") {
    message->set_prior(text);
    return absl::OkStatus();
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration, PriorCalibrationOf(text, fetch));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Nominal expected, nominal());
  TRUEPOSE_RETURN_IF_ERROR(CheckPrior(calibration, expected));
  message->set_prior("calibration");
  *message->mutable_prior_calibration() = convert::PriorOf(calibration);
  // A partial recalibration speaks of the parameters that are there.
  if (message->model().empty()) message->set_model(calibration.report().model());
  if (message->effects().empty()) {
    for (const std::string& effect : calibration.report().effects())
      message->set_effects(
          absl::StrCat(message->effects(), message->effects().empty() ? "" : ",", effect));
  }
  return absl::OkStatus();
}

absl::Status WriteJointSd(const std::string& text, v1::CalibrationOptions* message) {
  FaultList faults;
  for (absl::string_view word : absl::StrSplit(text, ',', absl::SkipWhitespace())) {
    double degrees = 0;
    if (!absl::SimpleAtod(word, &degrees))
      faults.Add("--joint-sd-deg", absl::StrCat("'", word, "'"), "numbers with commas, degrees");
    message->add_joint_sd(degrees * std::numbers::pi / 180);
  }
  return faults.ToStatus();
}

}  // namespace

const char kIdentificationFooter[] =
    R"(--calibrate says what is found anew:
  all, internal             everything that the readings determine (default)
  external, base, tool      frames alone; internal parameters stay as they are
  joint_offsets             base, tool and the offset of every joint
  NAME,NAME...              base, tool and these parameters, such as dq3
With --prior FILE the others stay as that calibration has them, and the report says whether the
change is real: 3 to 10 readings do.

)";

void AddIdentificationOptions(const Command& command, IdentificationOptions* options) {
  command
      .Option("--model", "NAME", &options->model,
              "modified_incremental (default), incremental, extended_dh or zhuang_roth")
      .Option("--estimator", "NAME", &options->estimator,
              "levenberg_marquardt (default), linear_iteration, kalman or simplex")
      .Option("--select", "RULE", &options->select,
              "Choose parameters: none (default), forward, bic or cross_validation")
      .Option("--effects", "LIST", &options->effects,
              "Joint effects: none (default), auto, or gain,harmonic1,harmonic2,compliance,"
              "temperature")
      .Option("--loss", "NAME", &options->loss,
              "Against readings that don't fit: none (default), huber or tukey")
      .Option("--calibrate", "PART", &options->calibrate, "What is found anew (below)")
      .Option("--prior", "WHAT", &options->prior,
              "none (default), tolerance (0.3 mm, 0.03 deg: for small sessions), or a calibration: "
              "a file of --output, or with a server a name such as ur10#3")
      .Option("--fixture", "FILE", &options->fixture,
              "Places in which the tool was put (pose matching, balls in sockets)")
      .Option("--feature-column", "COLUMN", &options->feature_column,
              "Column with the name of the fixture's feature; default: feature")
      .Option(
          "--joint-sd-deg", "LIST", &options->joint_sd_deg,
          "Noise of the joint readings in degrees (mm of a sliding joint / 17.45): one value or "
          "one a joint")
      .Option("--pose-matching", "FORM", &options->pose_matching,
              "task_space (default) or joint_space: residuals in joints, Eqs. 8 and 9")
      .Option("--joints", "SOURCE", &options->joints,
              "measured, commanded, or both: run both ways and keep the better");
}

Renaming IdentificationNames() {
  return {{"options.model", "--model"},
          {"options.estimator", "--estimator"},
          {"options.select", "--select"},
          {"options.effects", "--effects"},
          {"options.loss", "--loss"},
          {"options.calibrate", "--calibrate"},
          {"options.prior_calibration", "--prior"},
          {"options.prior", "--prior"},
          {"prior.", "--prior: "},
          {"options.fixture", "--fixture"},
          {"options.feature_column", "--feature-column"},
          {"options.joint_sd", "--joint-sd-deg"},
          {"options.pose_matching", "--pose-matching"},
          {"options.joints", "--joints"}};
}

absl::Status WriteIdentificationOptions(const IdentificationOptions& options,
                                        const FetchCalibration& fetch, const FetchNominal& nominal,
                                        v1::CalibrationOptions* message) {
  message->set_model(options.model);
  message->set_estimator(options.estimator);
  message->set_select(options.select);
  message->set_effects(options.effects);
  message->set_loss(options.loss);
  message->set_calibrate(options.calibrate);
  message->set_feature_column(options.feature_column);
  message->set_pose_matching(options.pose_matching);
  message->set_joints(options.joints);
  TRUEPOSE_RETURN_IF_ERROR(WriteJointSd(options.joint_sd_deg, message));
  if (!options.fixture.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(*message->mutable_fixture(), LoadFixture(options.fixture));
  }
  return WritePrior(options.prior, fetch, nominal, message);
}

}  // namespace truepose::cli
