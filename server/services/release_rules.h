// What release.h says, as plain checks.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "server/services/caller.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::services {

// What a calibration comes from.
struct Origin {
  v1::CalibrationJob job;
  std::vector<v1::Session> sessions;
};

// @returns kPermissionDenied that says why, and who may.
absl::Status CheckMayApprove(const Caller& caller, const v1::Robot& robot, const Origin& origin);

// @returns kPermissionDenied for a machine.
absl::Status CheckIsPerson(const Caller& caller);

// @returns kPermissionDenied for all but an admin's token.
absl::Status CheckIsAdmin(const Caller& caller);

// @returns kFailedPrecondition that names both states when `to` may not follow.
absl::Status CheckReleaseStep(const v1::Calibration& calibration, v1::ReleaseState to);

// @returns kFailedPrecondition for verdict do_not_apply: neither compensation nor a table takes it.
absl::Status CheckVerdict(const v1::Calibration& calibration);

// Why the server may not release it by itself, in words; "" = it may. `change_mm` is how far the
// flange moves against the active calibration, negative when there is none.
std::string WhyNotAutomatic(const v1::Robot& robot, const v1::Calibration& calibration,
                            double change_mm);

}  // namespace truepose::services
