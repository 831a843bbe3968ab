// Recalibration requests in the store: raising one, and its steps. Each within a transaction of the
// caller, so that what raises a request and the request are one commit.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/services/poses_to_measure.h"
#include "server/store/transaction.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::services {

inline constexpr char kServerPrincipal[] = "server";
inline constexpr absl::Duration kExpireAfter = absl::Hours(7 * 24);

// Why a robot should be recalibrated.
struct NewRequest {
  std::string robot;  // robots/{robot}
  std::string id;     // a UUID; "" = the server makes one
  v1::RecalibrationCause cause = v1::CAUSE_PERSON;
  std::string reason = "";
  std::string created_by = kServerPrincipal;
  std::string raised_by = "";  // a policy, event or drift check
  std::string calibrate = "";  // CalibrationOptions.calibrate
  // "" = in the time of the robot's policies, else in kExpireAfter.
  std::optional<absl::Time> expire_time = std::nullopt;
};

absl::StatusOr<std::optional<v1::RecalibrationRequest>> FindOpenRequest(store::Snapshot& snapshot,
                                                                        const std::string& robot);

// Stores a PENDING request, and with it the thinned pose set as poseSets/recalibration-{id}.
// @returns kAlreadyExists that names the open one, since a robot has at most one.
absl::StatusOr<v1::RecalibrationRequest> RaiseRequest(store::Transaction& transaction,
                                                      const NewRequest& request,
                                                      const PosesToMeasure& poses);

// The same for causes that the server finds: where a request is open already, the cause is appended
// to its steps, and nothing else is raised. @returns the raised one; nothing when one was open;
// NeedPoses() when one is to be raised and `poses` is nullptr, for WithPoses.
absl::StatusOr<std::optional<v1::RecalibrationRequest>> RaiseOrNote(store::Transaction& transaction,
                                                                    const NewRequest& request,
                                                                    const PosesToMeasure* poses);

// Writes the request, as it is changed by the caller, with one more step. Whether `to` may follow
// is the caller's to check (recalibration_rules.h).
absl::Status AppendStep(store::Transaction& transaction, v1::RecalibrationState to,
                        const std::string& principal, const std::string& reason,
                        v1::RecalibrationRequest& request);

}  // namespace truepose::services
