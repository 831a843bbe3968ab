// Handlers of CalibrationService that are about results (proto/truepose/v1/services.proto).
// @returns kInvalidArgument with every fault of the request and its field path; kNotFound for a
// name that is well
//   formed and unknown; what the store and convert say else. Nothing here writes.
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

inline constexpr int kMostTargets = 10'000;

absl::StatusOr<v1::Calibration> GetCalibration(const CallContext& call,
                                               const v1::GetCalibrationRequest& request);
absl::StatusOr<v1::ListCalibrationsResponse> ListCalibrations(
    const CallContext& call, const v1::ListCalibrationsRequest& request);
// A session that had a part in the calibration is evaluated too, with a warning.
// @returns kFailedPrecondition with a fault for a session that is not sealed or is of another
// robot.
absl::StatusOr<v1::Evaluation> Evaluate(const CallContext& call,
                                        const v1::EvaluateRequest& request);
// Each target that can't be corrected carries its own fault.
// Each session under each calibration, as by Evaluate: "before" of each evaluation is the nominal
// robot. At most 100.
absl::StatusOr<v1::CompareCalibrationsResponse> CompareCalibrations(
    const CallContext& call, const v1::CompareCalibrationsRequest& request);
absl::StatusOr<v1::CompensateResponse> Compensate(const CallContext& call,
                                                  const v1::CompensateRequest& request);

}  // namespace truepose::services
