#include "client/client.h"

#include <chrono>
#include <utility>

#include "client/address.h"
#include "client/channel.h"
#include "client/client_impl.h"
#include "client/status.h"
#include "client/token_file.h"
#include "client/uuid.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::client {
namespace {

// Calls that compute on the server.
constexpr int kComputeFactor = 10;

// Where a call goes to and how long it may take.
struct Target {
  const std::string& address;
  const ClientOptions& options;
  int factor;  // of the time that a call may take
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
  context.set_deadline(std::chrono::system_clock::now() +
                       target.options.call_timeout * target.factor);
  PrepareContext(context, target.options);
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

void PrepareContext(grpc::ClientContext& context, const ClientOptions& options) {
  context.AddMetadata(kErrorBytesKey, kErrorBytes);
  if (IsSecret(options.token)) context.AddMetadata("authorization", "Bearer " + options.token);
}

absl::StatusOr<Client> Client::Connect(const std::string& address, ClientOptions options) {
  TRUEPOSE_RETURN_IF_ERROR(ValidateAddress(address));
  if (!options.token.empty() && !IsSecret(options.token))
    return FaultStatus("token", "something else", "the secret of a token");
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
      tables(v1::CompensationTableService::NewStub(channel)),
      admin(v1::AdminService::NewStub(channel)),
      recalibrations(v1::RecalibrationService::NewStub(channel)),
      downloads(v1::DownloadService::NewStub(channel)),
      watches(v1::WatchService::NewStub(channel)) {}

Client::Client(std::shared_ptr<grpc::Channel> channel, std::string address, ClientOptions options)
    : impl_(std::make_unique<Impl>(std::move(channel), std::move(address), options)) {}

Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

const std::string& Client::address() const { return impl_->address; }

// A typed call is nothing but its stub's method.
#define TRUEPOSE_CALL(Service, service, Method, Request, Response, factor)                     \
  absl::StatusOr<v1::Response> Client::Method(const v1::Request& request) const {              \
    return Call<v1::Service::Stub, v1::Request, v1::Response>(                                 \
        {impl_->address, impl_->options, factor}, *impl_->service, &v1::Service::Stub::Method, \
        request);                                                                              \
  }
#define TRUEPOSE_ROBOT_CALL(Method, Response) \
  TRUEPOSE_CALL(RobotService, robots, Method, Method##Request, Response, 1)
#define TRUEPOSE_SESSION_CALL(Method, Response) \
  TRUEPOSE_CALL(SessionService, sessions, Method, Method##Request, Response, 1)
#define TRUEPOSE_ADMIN_CALL(Method, Response) \
  TRUEPOSE_CALL(AdminService, admin, Method, Method##Request, Response, 1)
#define TRUEPOSE_CALIBRATION_CALL(Method, Response, factor) \
  TRUEPOSE_CALL(CalibrationService, calibrations, Method, Method##Request, Response, factor)
#define TRUEPOSE_TABLE_CALL(Method, Response, factor) \
  TRUEPOSE_CALL(CompensationTableService, tables, Method, Method##Request, Response, factor)
#define TRUEPOSE_RECALIBRATION_CALL(Method, Response, factor) \
  TRUEPOSE_CALL(RecalibrationService, recalibrations, Method, Method##Request, Response, factor)

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
TRUEPOSE_TABLE_CALL(CreateCompensationTable, CompensationTable, kComputeFactor)
TRUEPOSE_TABLE_CALL(GetCompensationTable, CompensationTable, 1)
TRUEPOSE_TABLE_CALL(GetActiveCompensationTable, CompensationTable, 1)
TRUEPOSE_TABLE_CALL(ListCompensationTables, ListCompensationTablesResponse, 1)
TRUEPOSE_TABLE_CALL(DeleteCompensationTable, CompensationTable, 1)
TRUEPOSE_TABLE_CALL(UndeleteCompensationTable, CompensationTable, 1)
TRUEPOSE_ADMIN_CALL(Bootstrap, CreateTokenResponse)
TRUEPOSE_ADMIN_CALL(CreateToken, CreateTokenResponse)
TRUEPOSE_ADMIN_CALL(ListTokens, ListTokensResponse)
TRUEPOSE_ADMIN_CALL(RevokeToken, Token)
TRUEPOSE_ADMIN_CALL(GetServerStatus, ServerStatus)
TRUEPOSE_RECALIBRATION_CALL(CreateRobotEvent, RobotEvent, 1)
TRUEPOSE_RECALIBRATION_CALL(ListRobotEvents, ListRobotEventsResponse, 1)
TRUEPOSE_RECALIBRATION_CALL(CreateRecalibrationPolicy, RecalibrationPolicy, 1)
TRUEPOSE_RECALIBRATION_CALL(ListRecalibrationPolicies, ListRecalibrationPoliciesResponse, 1)
TRUEPOSE_RECALIBRATION_CALL(UpdateRecalibrationPolicy, RecalibrationPolicy, 1)
TRUEPOSE_RECALIBRATION_CALL(DeleteRecalibrationPolicy, RecalibrationPolicy, 1)
TRUEPOSE_RECALIBRATION_CALL(UndeleteRecalibrationPolicy, RecalibrationPolicy, 1)
TRUEPOSE_RECALIBRATION_CALL(CreateRecalibrationRequest, RecalibrationRequest, kComputeFactor)
TRUEPOSE_RECALIBRATION_CALL(GetRecalibrationRequest, RecalibrationRequest, 1)
TRUEPOSE_RECALIBRATION_CALL(ListRecalibrationRequests, ListRecalibrationRequestsResponse, 1)
TRUEPOSE_RECALIBRATION_CALL(AcknowledgeRecalibration, RecalibrationRequest, 1)
TRUEPOSE_RECALIBRATION_CALL(ReportMeasuring, RecalibrationRequest, 1)
TRUEPOSE_RECALIBRATION_CALL(CalibrateForRequest, RecalibrationRequest, 1)
TRUEPOSE_RECALIBRATION_CALL(DeclineRecalibration, RecalibrationRequest, 1)
TRUEPOSE_RECALIBRATION_CALL(CreateDriftCheck, DriftCheck, kComputeFactor)
TRUEPOSE_RECALIBRATION_CALL(ListDriftChecks, ListDriftChecksResponse, 1)
TRUEPOSE_RECALIBRATION_CALL(ReportAgent, AgentReport, 1)

}  // namespace truepose::client
