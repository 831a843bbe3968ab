// Talking to a server in the words of the command line.
#pragma once

#include <functional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/cli/command_line.h"
#include "client/client.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// Runs `call` with a client; a server that can't be reached gets the hint how to start or name one,
// one that asks for a token where it is looked for,
// a name that is unknown gets `not_found_hint`, such as "`truepose robot list` shows the robots".
absl::Status WithServer(const Invocation& invocation, absl::string_view not_found_hint,
                        const std::function<absl::Status(const client::Client&)>& call);

// The parts of a calibration's world that commands need together.
struct CalibratedRobot {
  v1::Calibration calibration;
  v1::Nominal nominal;  // the revision from which it was made
};
absl::StatusOr<CalibratedRobot> GetCalibratedRobot(const client::Client& client,
                                                   const std::string& calibration);

inline constexpr char kRobotHint[] = "`truepose robot list` shows the robots of this server.";
inline constexpr char kSessionHint[] = "`truepose session list` shows the sessions of this server.";
inline constexpr char kJobHint[] = "`truepose job list` shows the jobs of this server.";
inline constexpr char kCalibrationHint[] =
    "`truepose calibration list` shows the calibrations of this server.";

}  // namespace truepose::cli
