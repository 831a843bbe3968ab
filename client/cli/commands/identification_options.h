// Options of `calibrate` that say how parameters are found: texts of the command line, then fields
// of the message.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/cli/command_line.h"
#include "client/cli/outcome.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

struct IdentificationOptions {
  std::string model, estimator, select, effects, loss, calibrate, prior;
  std::string fixture, feature_column, joint_sd_deg, pose_matching, joints;
};

// Describes them, to be parsed into `options`.
void AddIdentificationOptions(const Command& command, IdentificationOptions* options);

// The footer's part on them.
extern const char kIdentificationFooter[];

// Renames fields of the message to options as they were typed.
Renaming IdentificationNames();

// A calibration named by --prior that is no file, such as ur10#3.
using FetchCalibration = std::function<absl::StatusOr<v1::Calibration>(const std::string& name)>;

// The nominal robot that a calibration of --prior must be of.
using FetchNominal = std::function<absl::StatusOr<v1::Nominal>()>;

// Writes them into the message; reads the files of --prior and --fixture.
// @param fetch empty where there is no server. @param nominal asked for a --prior only.
// @returns kInvalidArgument with faults of the files or of numbers, and for a prior that was edited
// or is of another nominal robot; what fetch and nominal return.
absl::Status WriteIdentificationOptions(const IdentificationOptions& options,
                                        const FetchCalibration& fetch, const FetchNominal& nominal,
                                        v1::CalibrationOptions* message);

}  // namespace truepose::cli
