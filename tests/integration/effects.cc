#include "tests/integration/effects.h"

#include <algorithm>
#include <chrono>

#include "absl/strings/str_cat.h"
#include "client/channel.h"
#include "client/reading_upload.h"
#include "client/wait_for_job.h"
#include "grpcpp/client_context.h"
#include "grpcpp/create_channel.h"
#include "grpcpp/security/credentials.h"
#include "gtest/gtest.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/plant_services.grpc.pb.h"
#include "truepose/v1/services.grpc.pb.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose::testing {
namespace {

constexpr int kUploadBatch = 3;  // readings, small so that a kill falls between many commits

bool MayHaveTakenEffect(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::CANCELLED:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return true;
    default:
      return false;
  }
}

// Asks until there is an answer. An error of the server itself fails the test.
template <typename Stub, typename Request, typename Reply>
Reply Ask(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Reply*),
          const Request& request) {
  Reply reply;
  for (int attempt = 0;; ++attempt) {
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    const grpc::Status status = (stub.*method)(&context, request, &reply);
    if (!status.ok() && MayHaveTakenEffect(status) && attempt < 100) continue;
    EXPECT_TRUE(status.ok()) << status.error_message() << "\n" << request.DebugString();
    return reply;
  }
}

// Grows as long as it is told to; reading n is at x = n mm.
class GrowingSpool : public client::ReadingSpool {
 public:
  explicit GrowingSpool(int session) : session_(absl::StrCat("sessions/", Uuid(session))) {}
  void Grow(int count) { last_ += count; }
  int64_t last_sequence() const override { return last_; }
  absl::StatusOr<client::SpooledReadings> Read(int64_t sequence, int most) override {
    client::SpooledReadings out{session_, {}};
    for (int i = 0; i < most; ++i) {
      v1::Reading& reading = out.readings.emplace_back();
      for (int joint = 0; joint < 5; ++joint) reading.add_joints_measured(0.1);
      reading.mutable_position_m()->set_x(1e-3 * static_cast<double>(sequence + i));
    }
    return out;
  }
  void SetDurable(int64_t sequence) override {
    EXPECT_GE(sequence, durable_) << "the server lost what it had acknowledged";
    durable_ = sequence;
  }
  int64_t durable() const { return durable_; }

 private:
  const std::string session_;
  int64_t last_ = 0, durable_ = 0;
};

}  // namespace

std::shared_ptr<grpc::Channel> ImpatientChannel(const std::string& address) {
  grpc::ChannelArguments arguments = client::ChannelArguments();
  for (const char* backoff : {GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS,
                              GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, GRPC_ARG_MAX_RECONNECT_BACKOFF_MS})
    arguments.SetInt(backoff, 20);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

void Approve(const std::string& address, const v1::ApproveCalibrationRequest& request) {
  const auto stub = v1::CalibrationService::NewStub(ImpatientChannel(address));
  Ask(*stub, &v1::CalibrationService::Stub::ApproveCalibration, request);
}

int64_t UploadReadings(const std::string& address, int source, int session, const Stop& stop) {
  const client::Client client(ImpatientChannel(address), address);
  GrowingSpool spool(session);
  const client::ReadingUploadOptions options{.batch_size = kUploadBatch, .batches_in_flight = 4};
  while (!stop.now) {
    spool.Grow(50 * kUploadBatch);
    EXPECT_THAT(client::UploadSpool(client, Uuid(source), spool, options), IsOk());
  }
  return spool.durable();
}

int64_t ChangeInstruments(const std::string& address, const Stop& stop) {
  using Stub = v1::PlantService::Stub;
  const auto plant = v1::PlantService::NewStub(ImpatientChannel(address));
  int64_t count = 0;
  for (; !stop.now; ++count) {
    auto request_id = [&, step = 0]() mutable {
      return Uuid(static_cast<int>(10'000'000 + 10 * count + step++));
    };
    const std::string id = absl::StrCat("i-", count + 1), name = "instruments/" + id;
    v1::CreateInstrumentRequest create;
    create.set_instrument_id(id);
    create.set_request_id(request_id());
    v1::Instrument instrument = Ask(*plant, &Stub::CreateInstrument, create);
    v1::UpdateInstrumentRequest update;
    *update.mutable_instrument() = instrument;  // with its etag: a second effect would be refused
    update.mutable_instrument()->set_display_name("changed");
    update.set_request_id(request_id());
    Ask(*plant, &Stub::UpdateInstrument, update);
    v1::DeleteInstrumentRequest remove;
    remove.set_name(name);
    remove.set_request_id(request_id());
    Ask(*plant, &Stub::DeleteInstrument, remove);
    v1::UndeleteInstrumentRequest undelete;
    undelete.set_name(name);
    undelete.set_request_id(request_id());
    Ask(*plant, &Stub::UndeleteInstrument, undelete);
  }
  return count;
}

void ChangeOneInstrument(const std::string& address, int writer, int changes, int name_bytes) {
  using Stub = v1::PlantService::Stub;
  const auto plant = v1::PlantService::NewStub(ImpatientChannel(address));
  const auto request_id = [&](int change) { return Uuid(40'000'000 + 100'000 * writer + change); };
  v1::CreateInstrumentRequest create;
  create.set_instrument_id(absl::StrCat("w-", writer));
  create.set_request_id(request_id(0));
  const v1::Instrument instrument = Ask(*plant, &Stub::CreateInstrument, create);
  for (int change = 1; change < changes; ++change) {
    v1::UpdateInstrumentRequest update;
    update.mutable_instrument()->set_name(instrument.name());
    std::string name = absl::StrCat(change, "-");
    name.resize(std::max<size_t>(name.size(), name_bytes), 'x');
    update.mutable_instrument()->set_display_name(name);
    update.mutable_update_mask()->add_paths("display_name");
    update.set_request_id(request_id(change));
    Ask(*plant, &Stub::UpdateInstrument, update);
  }
}

int64_t ActivateInTurn(const std::string& address, const Stop& stop) {
  const auto stub = v1::CalibrationService::NewStub(ImpatientChannel(address));
  int64_t count = 0;
  for (; !stop.now; ++count) {
    v1::ActivateCalibrationRequest request;
    request.set_name(absl::StrCat("robots/arm/calibrations/", count % 2 + 1));
    request.set_request_id(Uuid(static_cast<int>(20'000'000 + count)));
    Ask(*stub, &v1::CalibrationService::Stub::ActivateCalibration, request);
  }
  return count;
}

std::vector<std::string> RunJobs(const std::string& address, int session, const Stop& stop) {
  const auto channel = ImpatientChannel(address);
  const auto stub = v1::CalibrationService::NewStub(channel);
  const client::Client client(channel, address);
  std::vector<std::string> names;
  while (!stop.now) {
    auto request =
        JobRequest(Uuid(static_cast<int>(30'000'000 + names.size())), "arm", Uuid(session));
    request.set_request_id(request.job_id());
    const v1::CalibrationJob job =
        Ask(*stub, &v1::CalibrationService::Stub::CreateCalibrationJob, request);
    names.push_back(job.name());
    EXPECT_THAT(client::WaitForJob(client, job.name()), IsOk());
  }
  return names;
}

std::vector<v1::WatchEvent> EventsAfter(const std::string& address, int64_t revision) {
  const auto channel = ImpatientChannel(address);
  const auto stub = v1::WatchService::NewStub(channel);
  v1::WatchRequest request;
  grpc::ClientContext look;
  v1::WatchResponse response;
  // A snapshot tells the epoch and where the store is now.
  auto reader = stub->Watch(&look, request);
  while (reader->Read(&response) && !response.snapshot_complete()) {
  }
  const int64_t last = response.revision();
  look.TryCancel();
  reader->Finish();
  request.set_after_revision(revision);
  request.set_epoch(response.epoch());
  grpc::ClientContext context;
  reader = stub->Watch(&context, request);
  std::vector<v1::WatchEvent> events;
  while (response.revision() < last || events.empty()) {
    if (!reader->Read(&response)) break;
    events.insert(events.end(), response.events().begin(), response.events().end());
  }
  context.TryCancel();
  const grpc::Status end = reader->Finish();
  EXPECT_TRUE(end.ok() || end.error_code() == grpc::StatusCode::CANCELLED) << end.error_message();
  return events;
}

}  // namespace truepose::testing
