#include "bench/ingest_load.h"

#include <cstdio>
#include <cstdlib>
#include <latch>
#include <memory>
#include <mutex>
#include <vector>

#include "absl/strings/str_format.h"
#include "grpcpp/create_channel.h"
#include "grpcpp/security/credentials.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::bench {
namespace {

using Reactor = grpc::ClientBidiReactor<v1::AppendReadingsRequest, v1::AppendReadingsResponse>;

std::string Uuid(int kind, int client) {
  return absl::StrFormat("00000000-0000-4000-80%02d-%012d", kind, client);
}

// Six joints, a position and an orientation: 13 doubles.
v1::Reading MakeReading() {
  v1::Reading reading;
  for (int joint = 0; joint < 6; ++joint) reading.add_joints_measured(0.1 * joint + 0.01);
  reading.mutable_position_m()->set_x(1.25);
  reading.mutable_position_m()->set_y(-0.5);
  reading.mutable_position_m()->set_z(0.75);
  reading.mutable_orientation()->set_x(0.5);
  reading.mutable_orientation()->set_y(-0.5);
  reading.mutable_orientation()->set_z(0.5);
  reading.mutable_orientation()->set_w(0.5);
  return reading;
}

class Sender : public Reactor {
 public:
  Sender(const std::string& address, int client, const Load& load, std::latch& done)
      : load_(load), done_(done) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection of its own
    stub_ = v1::SessionService::NewStub(
        grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments));
    request_.set_source(Uuid(2, client));
    request_.set_session(SessionOf(client));
    for (int i = 0; i < load.batch; ++i) *request_.add_readings() = MakeReading();
  }

  void Begin() {
    stub_->async()->AppendReadings(&context_, this);
    StartRead(&response_);
    Next(false);
    StartCall();
  }

  void OnReadDone(bool ok) override {
    if (!ok) return;
    {
      std::lock_guard lock(mutex_);
      ++acknowledged_;
    }
    StartRead(&response_);
    Next(false);
  }
  void OnWriteDone(bool ok) override {
    if (ok) Next(true);
  }
  void OnDone(const grpc::Status& status) override {
    if (!status.ok() || response_.durable_sequence() != int64_t{load_.messages} * load_.batch) {
      std::fprintf(stderr, "upload: %s, durable up to %ld\n", status.error_message().c_str(),
                   static_cast<long>(response_.durable_sequence()));
      std::exit(1);
    }
    done_.count_down();
  }

 private:
  // Writes the next message when the window has room.
  void Next(bool written) {
    bool last = false;
    {
      std::lock_guard lock(mutex_);
      if (written) writing_ = false;
      if (writing_ || sent_ - acknowledged_ >= load_.window || sent_ == load_.messages) return;
      writing_ = true;
      request_.set_first_sequence(int64_t{sent_} * load_.batch + 1);
      request_.mutable_readings(0)->set_joints_measured(0, 1e-6 * sent_);
      last = ++sent_ == load_.messages;
    }
    if (last) {
      StartWriteLast(&request_, grpc::WriteOptions());
    } else {
      StartWrite(&request_);
    }
  }

  const Load load_;
  std::latch& done_;
  std::unique_ptr<v1::SessionService::Stub> stub_;
  grpc::ClientContext context_;
  v1::AppendReadingsRequest request_;
  v1::AppendReadingsResponse response_;
  std::mutex mutex_;
  int sent_ = 0, acknowledged_ = 0;
  bool writing_ = false;
};

}  // namespace

std::string SessionOf(int client) { return "sessions/" + Uuid(1, client); }

void Send(const std::string& address, const Load& load) {
  std::latch done(load.clients);
  std::vector<std::unique_ptr<Sender>> senders;
  for (int i = 0; i < load.clients; ++i) {
    senders.push_back(std::make_unique<Sender>(address, i, load, done));
  }
  for (const auto& sender : senders) sender->Begin();
  done.wait();
}

}  // namespace truepose::bench
