#include "server/rpc/latest_stream.h"
#include "server/services/bindings/binding.h"
#include "server/services/calibrations.h"
#include "server/services/jobs.h"
#include "server/services/release.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::services {
namespace {

using JobStream = rpc::LatestStream<v1::CalibrationJob>;

// The callbacks keep the stream and the stream keeps the subscription, until gRPC is done with the
// stream.
void StartWatch(const CallContext& call, const v1::WatchCalibrationJobRequest& request,
                const std::shared_ptr<JobStream>& stream) {
  auto subscription = rpc::Guarded([&] {
    return WatchCalibrationJob(
        call, request,
        {.on_job =
             [stream, call](const v1::CalibrationJob& job) {
               const absl::Status admitted = Recheck(call);
               if (!admitted.ok()) return stream->End(admitted);
               stream->Push(job);
             },
         .on_done = [stream](const absl::Status& status) { stream->End(status); }});
  });
  if (!subscription.ok()) return stream->End(subscription.status());
  stream->Hold(*std::move(subscription));
}

class CalibrationBinding final : public v1::CalibrationService::CallbackService {
 public:
  CalibrationBinding(const CallContext& call, const Executors& executors, rpc::Drain& drain)
      : call_(call), handlers_(executors.handlers), compute_(executors.compute), drain_(drain) {}

  // A preview computes; what is only stored must not wait behind it.
  TRUEPOSE_BIND(CreateCalibrationJob, CreateCalibrationJobRequest, CalibrationJob,
                (request->validate_only() ? compute_ : handlers_))
  TRUEPOSE_BIND(GetCalibrationJob, GetCalibrationJobRequest, CalibrationJob, handlers_)
  TRUEPOSE_BIND(ListCalibrationJobs, ListCalibrationJobsRequest, ListCalibrationJobsResponse,
                handlers_)
  TRUEPOSE_BIND(CancelCalibrationJob, CancelCalibrationJobRequest, CalibrationJob, handlers_)
  TRUEPOSE_BIND(GetCalibration, GetCalibrationRequest, Calibration, handlers_)
  TRUEPOSE_BIND(ListCalibrations, ListCalibrationsRequest, ListCalibrationsResponse, handlers_)
  TRUEPOSE_BIND(ApproveCalibration, ApproveCalibrationRequest, Calibration, handlers_)
  TRUEPOSE_BIND(RejectCalibration, RejectCalibrationRequest, Calibration, handlers_)
  TRUEPOSE_BIND(ActivateCalibration, ActivateCalibrationRequest, Calibration, handlers_)
  TRUEPOSE_BIND(RollBackCalibration, RollBackCalibrationRequest, Calibration, handlers_)
  TRUEPOSE_BIND(Evaluate, EvaluateRequest, Evaluation, compute_)
  TRUEPOSE_BIND(CompareCalibrations, CompareCalibrationsRequest, CompareCalibrationsResponse,
                compute_)
  TRUEPOSE_BIND(Compensate, CompensateRequest, CompensateResponse, compute_)

  grpc::ServerWriteReactor<v1::CalibrationJob>* WatchCalibrationJob(
      grpc::CallbackServerContext* context,
      const v1::WatchCalibrationJobRequest* request) override {
    const auto stream = JobStream::Make(rpc::MakeCall("WatchCalibrationJob", *context));
    drain_.Add(stream);
    static const auto access = auth::AccessTo("WatchCalibrationJob");
    const absl::StatusOr<CallContext> call = Admit(call_, access, *context);
    if (!call.ok()) {
      stream->End(call.status());
      return stream.get();
    }
    // The request is copied: the stream may be finished, and the request gone, before this runs.
    const bool accepted = handlers_.Submit(
        [call = *call, stream, request = *request] { StartWatch(call, request, stream); });
    if (!accepted) stream->End(rpc::TooBusy());
    return stream.get();
  }

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
  rpc::Executor& compute_;
  rpc::Drain& drain_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindCalibrationService(const CallContext& call,
                                                      const Executors& executors,
                                                      rpc::Drain& drain) {
  return std::make_unique<CalibrationBinding>(call, executors, drain);
}

}  // namespace truepose::services
