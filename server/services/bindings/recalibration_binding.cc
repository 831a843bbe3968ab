#include "server/services/bindings/binding.h"
#include "server/services/drift_checks.h"
#include "server/services/recalibration.h"
#include "server/services/robot_events.h"
#include "server/services/standard.h"
#include "truepose/v1/recalibration_services.grpc.pb.h"

namespace truepose::services {
namespace {

class RecalibrationBinding final : public v1::RecalibrationService::CallbackService {
 public:
  RecalibrationBinding(const CallContext& call, const Executors& executors)
      : call_(call), handlers_(executors.handlers), compute_(executors.compute) {}

  TRUEPOSE_BIND_RESOURCE(RecalibrationPolicy, RecalibrationPolicies)
  // May raise a request, which chooses poses.
  TRUEPOSE_BIND(CreateRobotEvent, CreateRobotEventRequest, RobotEvent, compute_)
  TRUEPOSE_BIND_STANDARD(GetRobotEvent, RobotEvent, GetStandard)
  TRUEPOSE_BIND_STANDARD(ListRobotEvents, ListRobotEventsResponse, ListStandard)
  TRUEPOSE_BIND_STANDARD(GetRecalibrationRequest, RecalibrationRequest, GetStandard)
  TRUEPOSE_BIND_STANDARD(ListRecalibrationRequests, ListRecalibrationRequestsResponse, ListStandard)
  TRUEPOSE_BIND(CreateDriftCheck, CreateDriftCheckRequest, DriftCheck, compute_)
  TRUEPOSE_BIND_STANDARD(GetDriftCheck, DriftCheck, GetStandard)
  TRUEPOSE_BIND_STANDARD(ListDriftChecks, ListDriftChecksResponse, ListStandard)
  TRUEPOSE_BIND_STANDARD(ListAgentReports, ListAgentReportsResponse, ListStandard)
  TRUEPOSE_BIND(ReportAgent, ReportAgentRequest, AgentReport, handlers_)
  // Chooses poses.
  TRUEPOSE_BIND(CreateRecalibrationRequest, CreateRecalibrationRequestRequest, RecalibrationRequest,
                compute_)
  TRUEPOSE_BIND(AcknowledgeRecalibration, AcknowledgeRecalibrationRequest, RecalibrationRequest,
                handlers_)
  TRUEPOSE_BIND(ReportMeasuring, ReportMeasuringRequest, RecalibrationRequest, handlers_)
  TRUEPOSE_BIND(CalibrateForRequest, CalibrateForRequestRequest, RecalibrationRequest, handlers_)
  TRUEPOSE_BIND(DeclineRecalibration, DeclineRecalibrationRequest, RecalibrationRequest, handlers_)

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
  rpc::Executor& compute_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindRecalibrationService(const CallContext& call,
                                                        const Executors& executors) {
  return std::make_unique<RecalibrationBinding>(call, executors);
}

}  // namespace truepose::services
