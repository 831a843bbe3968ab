// A gRPC server within the process around a scripted service.
#pragma once

#include <memory>
#include <string>
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
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    server_ = builder.BuildAndStart();
  }
  ~FakeServer() { server_->Shutdown(); }

  // Over a connection: channels within a process repeat nothing.
  Client Connect() const { return *Client::Connect("127.0.0.1:" + std::to_string(port_)); }
  Client MakeClient(ClientOptions options = {}) const {
    return Client(server_->InProcessChannel(ChannelArguments()), "the fake", options);
  }

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace truepose::client::testing
