// The two ways of `truepose calibrate`: same options, same messages, same report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/cli/command_line.h"
#include "client/cli/commands/identification_options.h"
#include "client/cli/output_file.h"
#include "formats/urdf.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

struct CalibrateOptions {
  bool local = false;
  std::string robot;                  // a name, or with --local a file
  std::vector<std::string> sessions;  // names, or with --local files
  std::string euler;                  // only with --local: a session on a server is read already
  std::string observe;
  std::string output;
  bool no_wait = false;  // only remote
  bool preview = false;
  formats::UrdfEnds ends;  // only with --local
  IdentificationOptions identification;
  v1::CalibrationOptions calibration;  // those of `identification` are written by each way
};

absl::Status CalibrateLocally(const Invocation& invocation, const CalibrateOptions& options);
absl::Status CalibrateOnServer(const Invocation& invocation, const CalibrateOptions& options);

// Faults of the message in the words of the command line: `--split`, `--tool`, and the sessions as
// they were typed.
absl::Status AsTyped(const absl::Status& status, const CalibrateOptions& options);

// "identification, iteration 3"
std::string StageText(const v1::JobProgress& progress);

// nullopt without --output; made before the run, so that a bad place is told before the work.
absl::StatusOr<std::optional<OutputFile>> OpenOutput(const CalibrateOptions& options);

// What a run would identify, for people, or the JobPreview with --json.
absl::Status ReplyPreview(const Invocation& invocation, const v1::JobPreview& preview);

// Writes the file and prints the report; with --json the CalibrationReport alone. Then an
// AnsweredFailure when the run did not converge.
// @param next_step the last line for people.
absl::Status Deliver(const Invocation& invocation, const v1::Calibration& calibration,
                     std::optional<OutputFile> output, const std::string& next_step);

}  // namespace truepose::cli
