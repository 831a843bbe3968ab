// A gRPC server within the process around a scripted service.
#pragma once

#include <memory>
#include <utility>

#include "client/channel.h"
#include "client/client.h"
#include "grpcpp/server.h"
#include "grpcpp/server_builder.h"

namespace truepose::client::testing {

class FakeServer {
 public:
  explicit FakeServer(grpc::Service& service) {
    grpc::ServerBuilder builder;
    builder.RegisterService(&service);
    server_ = builder.BuildAndStart();
  }
  ~FakeServer() { server_->Shutdown(); }

  Client MakeClient(ClientOptions options = {}) const {
    return Client(server_->InProcessChannel(ChannelArguments()), "the fake", options);
  }

 private:
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace truepose::client::testing
