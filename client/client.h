// Typed calls to a Truepose server: one request message in, one reply message or a status out.
//
// A status has the code that the server chose by what the caller should do, and carries every fault
// of the request (core/base/fault.h: FaultsOf), so a remote answer prints the same lines as a local
// one. When no server answers the code is kUnavailable and the message names the address. A call
// that failed with kUnavailable or kDeadlineExceeded may or may not have taken effect. A request
// that changes something gets a request_id here unless it has one, so the repeats of one call
// (service_config.h) have one effect and one answer; who wants to repeat a call as a whole gives
// the request_id.
//
// A Client may be used by many threads at once.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "google/protobuf/message.h"
#include "truepose/v1/admin_services.pb.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/compensation_table_services.pb.h"
#include "truepose/v1/download_services.pb.h"
#include "truepose/v1/recalibration_services.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/session.pb.h"
#include "truepose/v1/watch.pb.h"

namespace grpc {
class Channel;
}

namespace truepose::client {

class AppendStream;

struct ClientOptions {
  // Of one call, its repeats included. What computes on the server, such as Evaluate, Compensate
  // and the estimate of a table, gets ten times as long.
  std::chrono::milliseconds call_timeout{30'000};
  // The secret of the caller's token (token_file.h), sent with every call and said in no message;
  // "" = none.
  std::string token = {};
};

class Client {
 public:
  // @param address "host:port", "unix:/path" or "unix:relative/path".
  // Does not connect yet: an unreachable server shows at the first call.
  // @returns kInvalidArgument with a fault when the address can't be read, or the token can't be
  // sent.
  static absl::StatusOr<Client> Connect(const std::string& address, ClientOptions options = {});

  // Over a channel that is there already, such as one within the process. `address` is for
  // messages.
  Client(std::shared_ptr<grpc::Channel> channel, std::string address, ClientOptions options = {});
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  absl::StatusOr<v1::Robot> CreateRobot(const v1::CreateRobotRequest& request) const;
  absl::StatusOr<v1::Robot> GetRobot(const v1::GetRobotRequest& request) const;
  absl::StatusOr<v1::ListRobotsResponse> ListRobots(const v1::ListRobotsRequest& request) const;
  absl::StatusOr<v1::NominalRevision> CreateNominalRevision(
      const v1::CreateNominalRevisionRequest& request) const;
  absl::StatusOr<v1::NominalRevision> GetNominalRevision(
      const v1::GetNominalRevisionRequest& request) const;
  absl::StatusOr<v1::ListNominalRevisionsResponse> ListNominalRevisions(
      const v1::ListNominalRevisionsRequest& request) const;

  absl::StatusOr<v1::Session> CreateSession(const v1::CreateSessionRequest& request) const;
  absl::StatusOr<v1::Session> GetSession(const v1::GetSessionRequest& request) const;
  absl::StatusOr<v1::ListSessionsResponse> ListSessions(
      const v1::ListSessionsRequest& request) const;
  absl::StatusOr<v1::Session> SealSession(const v1::SealSessionRequest& request) const;
  absl::StatusOr<v1::ListReadingsResponse> ListReadings(
      const v1::ListReadingsRequest& request) const;

  absl::StatusOr<v1::CalibrationJob> CreateCalibrationJob(
      const v1::CreateCalibrationJobRequest& request) const;
  absl::StatusOr<v1::CalibrationJob> GetCalibrationJob(
      const v1::GetCalibrationJobRequest& request) const;
  absl::StatusOr<v1::ListCalibrationJobsResponse> ListCalibrationJobs(
      const v1::ListCalibrationJobsRequest& request) const;
  absl::StatusOr<v1::CalibrationJob> CancelCalibrationJob(
      const v1::CancelCalibrationJobRequest& request) const;
  absl::StatusOr<v1::Calibration> GetCalibration(const v1::GetCalibrationRequest& request) const;
  absl::StatusOr<v1::ListCalibrationsResponse> ListCalibrations(
      const v1::ListCalibrationsRequest& request) const;
  absl::StatusOr<v1::Calibration> ApproveCalibration(
      const v1::ApproveCalibrationRequest& request) const;
  absl::StatusOr<v1::Calibration> RejectCalibration(
      const v1::RejectCalibrationRequest& request) const;
  absl::StatusOr<v1::Calibration> ActivateCalibration(
      const v1::ActivateCalibrationRequest& request) const;
  absl::StatusOr<v1::Calibration> RollBackCalibration(
      const v1::RollBackCalibrationRequest& request) const;
  absl::StatusOr<v1::CompareCalibrationsResponse> CompareCalibrations(
      const v1::CompareCalibrationsRequest& request) const;
  absl::StatusOr<v1::Evaluation> Evaluate(const v1::EvaluateRequest& request) const;
  absl::StatusOr<v1::CompensateResponse> Compensate(const v1::CompensateRequest& request) const;

  absl::StatusOr<v1::CompensationTable> CreateCompensationTable(
      const v1::CreateCompensationTableRequest& request) const;
  absl::StatusOr<v1::CompensationTable> GetCompensationTable(
      const v1::GetCompensationTableRequest& request) const;
  // The one to apply; kNotFound says why there is none.
  absl::StatusOr<v1::CompensationTable> GetActiveCompensationTable(
      const v1::GetActiveCompensationTableRequest& request) const;
  absl::StatusOr<v1::ListCompensationTablesResponse> ListCompensationTables(
      const v1::ListCompensationTablesRequest& request) const;
  absl::StatusOr<v1::CompensationTable> DeleteCompensationTable(
      const v1::DeleteCompensationTableRequest& request) const;
  absl::StatusOr<v1::CompensationTable> UndeleteCompensationTable(
      const v1::UndeleteCompensationTableRequest& request) const;

  absl::StatusOr<v1::CreateTokenResponse> Bootstrap(const v1::BootstrapRequest& request) const;
  absl::StatusOr<v1::CreateTokenResponse> CreateToken(const v1::CreateTokenRequest& request) const;
  absl::StatusOr<v1::ListTokensResponse> ListTokens(const v1::ListTokensRequest& request) const;
  absl::StatusOr<v1::Token> RevokeToken(const v1::RevokeTokenRequest& request) const;
  absl::StatusOr<v1::ServerStatus> GetServerStatus(const v1::GetServerStatusRequest& request) const;
  absl::StatusOr<v1::RobotEvent> CreateRobotEvent(const v1::CreateRobotEventRequest& request) const;
  absl::StatusOr<v1::ListRobotEventsResponse> ListRobotEvents(
      const v1::ListRobotEventsRequest& request) const;
  absl::StatusOr<v1::RecalibrationPolicy> CreateRecalibrationPolicy(
      const v1::CreateRecalibrationPolicyRequest& request) const;
  absl::StatusOr<v1::ListRecalibrationPoliciesResponse> ListRecalibrationPolicies(
      const v1::ListRecalibrationPoliciesRequest& request) const;
  absl::StatusOr<v1::RecalibrationPolicy> UpdateRecalibrationPolicy(
      const v1::UpdateRecalibrationPolicyRequest& request) const;
  absl::StatusOr<v1::RecalibrationPolicy> DeleteRecalibrationPolicy(
      const v1::DeleteRecalibrationPolicyRequest& request) const;
  absl::StatusOr<v1::RecalibrationPolicy> UndeleteRecalibrationPolicy(
      const v1::UndeleteRecalibrationPolicyRequest& request) const;
  absl::StatusOr<v1::RecalibrationRequest> CreateRecalibrationRequest(
      const v1::CreateRecalibrationRequestRequest& request) const;
  absl::StatusOr<v1::RecalibrationRequest> GetRecalibrationRequest(
      const v1::GetRecalibrationRequestRequest& request) const;
  absl::StatusOr<v1::ListRecalibrationRequestsResponse> ListRecalibrationRequests(
      const v1::ListRecalibrationRequestsRequest& request) const;
  absl::StatusOr<v1::RecalibrationRequest> AcknowledgeRecalibration(
      const v1::AcknowledgeRecalibrationRequest& request) const;
  absl::StatusOr<v1::RecalibrationRequest> ReportMeasuring(
      const v1::ReportMeasuringRequest& request) const;
  absl::StatusOr<v1::RecalibrationRequest> CalibrateForRequest(
      const v1::CalibrateForRequestRequest& request) const;
  absl::StatusOr<v1::RecalibrationRequest> DeclineRecalibration(
      const v1::DeclineRecalibrationRequest& request) const;
  absl::StatusOr<v1::DriftCheck> CreateDriftCheck(const v1::CreateDriftCheckRequest& request) const;
  absl::StatusOr<v1::ListDriftChecksResponse> ListDriftChecks(
      const v1::ListDriftChecksRequest& request) const;
  absl::StatusOr<v1::AgentReport> ReportAgent(const v1::ReportAgentRequest& request) const;

  // One stream of the job's states: the present one, then each change. `on_job` is called in this
  // thread and ends the stream by returning false. `is_cancelled`, when given, is asked a few times
  // a second.
  // @returns OK when the stream ended after a terminal state or by on_job; kCancelled by
  // is_cancelled; else the
  //   reason. wait_for_job.h connects again when the stream breaks; most callers want that.
  absl::Status WatchCalibrationJob(const std::string& name,
                                   const std::function<bool(const v1::CalibrationJob&)>& on_job,
                                   const std::function<bool()>& is_cancelled = {}) const;

  // Any unary RPC of the API, for programs that treat all kinds of resources alike.
  // @param method such as "truepose.v1.PlantService/CreateInstrument".
  // @param response of the method's output type; unspecified after an error.
  absl::Status CallMethod(const std::string& method, const google::protobuf::Message& request,
                          google::protobuf::Message* response) const;

  // One stream of what changes, as WatchCalibrationJob. watch.h connects again; most callers want
  // that.
  absl::Status Watch(const v1::WatchRequest& request,
                     const std::function<bool(const v1::WatchResponse&)>& on_response,
                     const std::function<bool()>& is_cancelled = {}) const;

  // One stream of chunks; `on_chunk` ends it by returning false. download.h is the whole download.
  absl::Status ReadDownload(const v1::DownloadRequest& request,
                            const std::function<bool(const v1::DownloadResponse&)>& on_chunk) const;

  // A stream of batches; append_readings.h is the whole upload.
  std::unique_ptr<AppendStream> OpenAppendStream() const;

  const std::string& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Batches of readings in, an acknowledgement a batch out. One thread may write while another reads.
class AppendStream {
 public:
  virtual ~AppendStream() = default;
  // Waits while the server is behind. false: the stream is broken, and Finish says why.
  virtual bool Write(const v1::AppendReadingsRequest& batch) = 0;
  // No more batches; acknowledgements still come.
  virtual void WritesDone() = 0;
  // The next acknowledgement; false: none will come, and Finish says why.
  virtual bool Read(v1::AppendReadingsResponse* acknowledgement) = 0;
  // The server's last word; call it once, after Read or Write returned false.
  virtual absl::Status Finish() = 0;
};

}  // namespace truepose::client
