#include "client/cli/remote.h"

#include <utility>

#include "client/cli/outcome.h"
#include "client/token_file.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kServerHint[] =
    "Start a server with `truepose serve`, or name one with --server ADDRESS or TRUEPOSE_SERVER.";
constexpr char kTokenHint[] =
    "Show your token with --token-file FILE, TRUEPOSE_TOKEN or ~/.config/truepose/token.";

}  // namespace

absl::Status WithServer(const Invocation& invocation, absl::string_view not_found_hint,
                        const std::function<absl::Status(const client::Client&)>& call) {
  TRUEPOSE_ASSIGN_OR_RETURN(std::string token, client::FindToken(invocation.token_file));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const client::Client client,
      client::Client::Connect(invocation.server, {.token = std::move(token)}));
  absl::Status status = WithHint(call(client), absl::StatusCode::kNotFound, not_found_hint);
  status = WithHint(status, absl::StatusCode::kUnauthenticated, kTokenHint);
  return WithHint(status, absl::StatusCode::kUnavailable, kServerHint);
}

absl::StatusOr<CalibratedRobot> GetCalibratedRobot(const client::Client& client,
                                                   const std::string& calibration) {
  v1::GetCalibrationRequest get_calibration;
  get_calibration.set_name(calibration);
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration found, client.GetCalibration(get_calibration));
  v1::GetNominalRevisionRequest get_revision;
  get_revision.set_name(found.nominal_revision());
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::NominalRevision revision,
                            client.GetNominalRevision(get_revision));
  return CalibratedRobot{std::move(found), revision.nominal()};
}

}  // namespace truepose::cli
