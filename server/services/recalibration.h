// Handlers of RecalibrationService that are about requests (proto/truepose/v1/recalibration.proto);
// their way is in recalibration_rules.h. Each is done once for a request id.
// @returns kInvalidArgument with every fault of the request; kNotFound; kFailedPrecondition for a
// state from which that step doesn't lead, with the state found and what is possible.
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/recalibration_services.pb.h"

namespace truepose::services {

// Raised by the caller: cause is CAUSE_PERSON, `raised_by` empty. The same id with the same content
// gives the request as it is now. Its pose set is the one asked for, else as PlanPoses says.
// @returns kAlreadyExists that names the robot's open request; kFailedPrecondition when no pose set
// was asked for and none can be made.
absl::StatusOr<v1::RecalibrationRequest> CreateRecalibrationRequest(
    const CallContext& call, const v1::CreateRecalibrationRequestRequest& request);
absl::StatusOr<v1::RecalibrationRequest> AcknowledgeRecalibration(
    const CallContext& call, const v1::AcknowledgeRecalibrationRequest& request);
// A session of the robot, open or sealed. Repeated with more readings or another session; "" = the
// one named before.
absl::StatusOr<v1::RecalibrationRequest> ReportMeasuring(const CallContext& call,
                                                         const v1::ReportMeasuringRequest& request);
// Creates the job over the sealed session (recalibration_job.h) and wakes a worker.
absl::StatusOr<v1::RecalibrationRequest> CalibrateForRequest(
    const CallContext& call, const v1::CalibrateForRequestRequest& request);
// A job that runs for it already is not cancelled.
absl::StatusOr<v1::RecalibrationRequest> DeclineRecalibration(
    const CallContext& call, const v1::DeclineRecalibrationRequest& request);

// Stores the report as the agent's latest, whatever the one before said. @returns kInvalidArgument
// with every fault of the report; kNotFound for its robot.
absl::StatusOr<v1::AgentReport> ReportAgent(const CallContext& call,
                                            const v1::ReportAgentRequest& request);

}  // namespace truepose::services
