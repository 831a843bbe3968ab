#include "bench/peers/grpc_echo.h"

#include "grpcpp/security/server_credentials.h"
#include "grpcpp/server.h"
#include "grpcpp/server_builder.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::bench {
namespace {

using Reactor = grpc::ServerBidiReactor<v1::AppendReadingsRequest, v1::AppendReadingsResponse>;

class EchoStream : public Reactor {
 public:
  EchoStream() { StartRead(&request_); }
  void OnReadDone(bool ok) override {
    if (!ok) return Finish(grpc::Status::OK);
    response_.set_durable_sequence(request_.first_sequence() + request_.readings_size() - 1);
    StartWrite(&response_);
  }
  void OnWriteDone(bool ok) override {
    if (ok) StartRead(&request_);
    if (!ok) Finish(grpc::Status::CANCELLED);
  }
  void OnDone() override { delete this; }

 private:
  v1::AppendReadingsRequest request_;
  v1::AppendReadingsResponse response_;
};

class EchoService : public v1::SessionService::CallbackService {
 public:
  Reactor* AppendReadings(grpc::CallbackServerContext*) override { return new EchoStream; }
};

}  // namespace

struct GrpcEcho::Parts {
  EchoService service;
  std::unique_ptr<grpc::Server> server;
  std::string address;
};

GrpcEcho::GrpcEcho() : parts_(std::make_unique<Parts>()) {
  int port = 0;
  grpc::ServerBuilder builder;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&parts_->service);
  parts_->server = builder.BuildAndStart();
  parts_->address = "127.0.0.1:" + std::to_string(port);
}

GrpcEcho::~GrpcEcho() { parts_->server->Shutdown(); }

const std::string& GrpcEcho::address() const { return parts_->address; }

}  // namespace truepose::bench
