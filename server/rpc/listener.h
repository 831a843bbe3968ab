// gRPC's server with our limits: services in, one address out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "grpcpp/channel.h"
#include "grpcpp/impl/codegen/service_type.h"
#include "grpcpp/server.h"

namespace truepose::rpc {

// Of a request.
inline constexpr int kMostMessageBytes = 16 << 20;

class Listener {
 public:
  // Serves `services`, which outlive the listener, with health (grpc.health.v1) and reflection
  // beside them.
  // @param address "unix:path" or "host:port"; port 0 takes any.
  // @returns kUnavailable when the address can't be listened at.
  static absl::StatusOr<std::unique_ptr<Listener>> Start(
      const std::vector<std::unique_ptr<grpc::Service>>& services, const std::string& address);
  // Cuts what is still open.
  ~Listener();

  // As clients write it, with the port that was taken.
  const std::string& address() const { return address_; }
  std::shared_ptr<grpc::Channel> InProcessChannel(const grpc::ChannelArguments& arguments);

  // Health says NOT_SERVING from now on; calls are still served.
  void StopServing();
  // No new calls; those under way get `grace`, then they are cut.
  void Shutdown(absl::Duration grace);

 private:
  Listener() = default;

  std::unique_ptr<grpc::Server> server_;
  std::string address_;
};

}  // namespace truepose::rpc
