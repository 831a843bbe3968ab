#include "client/client.h"

#include <chrono>
#include <utility>

#include "client/address.h"
#include "client/channel.h"
#include "client/client_impl.h"
#include "client/status.h"
#include "client/uuid.h"
#include "core/base/status_macros.h"

namespace truepose::client {
namespace {

// Calls that compute on the server.
constexpr int kComputeFactor = 10;

// Where a call goes to and how long it may take.
struct Target {
  const std::string& address;
  std::chrono::milliseconds timeout;
};

// A repeat of a request with an id gets the first answer, so what changes something gets one.
template <typename Request>
Request WithRequestId(Request request) {
  if (request.request_id().empty()) request.set_request_id(RandomUuid());
  return request;
}

// One unary call of `stub` with the deadline, the metadata and the statuses of this library.
template <typename Stub, typename Request, typename Response>
absl::StatusOr<Response> Call(const Target& target, Stub& stub,
                              grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&,
                                                           Response*),
                              const Request& request) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + target.timeout);
  PrepareContext(context);
  Response response;
  grpc::Status status;
  if constexpr (requires { request.request_id(); }) {
    status = (stub.*method)(&context, WithRequestId(request), &response);
  } else {
    status = (stub.*method)(&context, request, &response);
  }
  if (!status.ok()) return FromGrpcStatus(status, target.address);
  return response;
}

}  // namespace

void PrepareContext(grpc::ClientContext& context) {
  context.AddMetadata(kErrorBytesKey, kErrorBytes);
}

absl::StatusOr<Client> Client::Connect(const std::string& address, ClientOptions options) {
  TRUEPOSE_RETURN_IF_ERROR(ValidateAddress(address));
  return Client(MakeChannel(address), address, options);
}

Client::Impl::Impl(std::shared_ptr<grpc::Channel> connection, std::string server,
                   ClientOptions limits)
    : address(std::move(server)),
      options(limits),
      channel(std::move(connection)),
      robots(v1::RobotService::NewStub(channel)),
      sessions(v1::SessionService::NewStub(channel)),
      calibrations(v1::CalibrationService::NewStub(channel)),
      downloads(v1::DownloadService::NewStub(channel)),
      watches(v1::WatchService::NewStub(channel)) {}

Client::Client(std::shared_ptr<grpc::Channel> channel, std::string address, ClientOptions options)
    : impl_(std::make_unique<Impl>(std::move(channel), std::move(address), options)) {}

Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

const std::string& Client::address() const { return impl_->address; }

// A typed call is nothing but its stub's method.
#define TRUEPOSE_CALL(Service, service, Method, Request, Response, factor)        \
  absl::StatusOr<v1::Response> Client::Method(const v1::Request& request) const { \
    return Call<v1::Service::Stub, v1::Request, v1::Response>(                    \
        {impl_->address, impl_->options.call_timeout * factor}, *impl_->service,  \
        &v1::Service::Stub::Method, request);                                     \
  }
#define TRUEPOSE_ROBOT_CALL(Method, Response) \
  TRUEPOSE_CALL(RobotService, robots, Method, Method##Request, Response, 1)
#define TRUEPOSE_SESSION_CALL(Method, Response) \
  TRUEPOSE_CALL(SessionService, sessions, Method, Method##Request, Response, 1)
#define TRUEPOSE_CALIBRATION_CALL(Method, Response, factor) \
  TRUEPOSE_CALL(CalibrationService, calibrations, Method, Method##Request, Response, factor)

TRUEPOSE_ROBOT_CALL(CreateRobot, Robot)
TRUEPOSE_ROBOT_CALL(GetRobot, Robot)
TRUEPOSE_ROBOT_CALL(ListRobots, ListRobotsResponse)
TRUEPOSE_ROBOT_CALL(CreateNominalRevision, NominalRevision)
TRUEPOSE_ROBOT_CALL(GetNominalRevision, NominalRevision)
TRUEPOSE_ROBOT_CALL(ListNominalRevisions, ListNominalRevisionsResponse)
TRUEPOSE_SESSION_CALL(CreateSession, Session)
TRUEPOSE_SESSION_CALL(GetSession, Session)
TRUEPOSE_SESSION_CALL(ListSessions, ListSessionsResponse)
TRUEPOSE_SESSION_CALL(SealSession, Session)
TRUEPOSE_SESSION_CALL(ListReadings, ListReadingsResponse)
TRUEPOSE_CALIBRATION_CALL(CreateCalibrationJob, CalibrationJob, 1)
TRUEPOSE_CALIBRATION_CALL(GetCalibrationJob, CalibrationJob, 1)
TRUEPOSE_CALIBRATION_CALL(ListCalibrationJobs, ListCalibrationJobsResponse, 1)
TRUEPOSE_CALIBRATION_CALL(CancelCalibrationJob, CalibrationJob, 1)
TRUEPOSE_CALIBRATION_CALL(GetCalibration, Calibration, 1)
TRUEPOSE_CALIBRATION_CALL(ListCalibrations, ListCalibrationsResponse, 1)
TRUEPOSE_CALIBRATION_CALL(ApproveCalibration, Calibration, 1)
TRUEPOSE_CALIBRATION_CALL(RejectCalibration, Calibration, 1)
TRUEPOSE_CALIBRATION_CALL(ActivateCalibration, Calibration, 1)
TRUEPOSE_CALIBRATION_CALL(RollBackCalibration, Calibration, 1)
TRUEPOSE_CALIBRATION_CALL(CompareCalibrations, CompareCalibrationsResponse, kComputeFactor)
TRUEPOSE_CALIBRATION_CALL(Evaluate, Evaluation, kComputeFactor)
TRUEPOSE_CALIBRATION_CALL(Compensate, CompensateResponse, kComputeFactor)

}  // namespace truepose::client
