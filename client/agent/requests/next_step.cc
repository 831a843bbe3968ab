#include "client/agent/requests/next_step.h"

#include "client/agent/requests/request_book.h"

namespace truepose::agent {
namespace {

// Whether a job has been made of this session before: then another one would end as that did.
bool WasTried(const v1::RecalibrationRequest& request, const std::string& session) {
  bool tried = false;
  for (const v1::RecalibrationStep& step : request.steps()) {
    if (step.state() == v1::REQUEST_MEASURING && step.reason() == session) tried = false;
    if (step.state() == v1::REQUEST_CALIBRATING) tried = true;
  }
  return tried;
}

StepKind WhileMeasuring(const OpenRequest& open, const RequestSession& session) {
  const v1::RecalibrationRequest& request = open.request;
  if (request.session() != open.session) return StepKind::kReport;
  if (session.settled)
    return WasTried(request, open.session) ? StepKind::kNone : StepKind::kCalibrate;
  return request.readings_taken() == session.delivered ? StepKind::kNone : StepKind::kReport;
}

}  // namespace

StepKind NextStep(const OpenRequest& open, const RequestSession& session,
                  const NextStepOptions& options) {
  const v1::RecalibrationRequest& request = open.request;
  if (!IsOpen(request.state())) return StepKind::kNone;
  if (!open.decline_reason.empty()) return StepKind::kDecline;
  if (!open.has_poses && !request.pose_set().empty()) return StepKind::kFetchPoses;
  const bool measured = !open.session.empty() && (session.delivered > 0 || session.settled);
  switch (request.state()) {
    case v1::REQUEST_PENDING:
      // Who measures for it has taken it.
      return options.acknowledge || measured ? StepKind::kAcknowledge : StepKind::kNone;
    case v1::REQUEST_ACKNOWLEDGED:
      return measured ? StepKind::kReport : StepKind::kNone;
    case v1::REQUEST_MEASURING:
      return measured ? WhileMeasuring(open, session) : StepKind::kNone;
    default:
      return StepKind::kNone;
  }
}

}  // namespace truepose::agent
