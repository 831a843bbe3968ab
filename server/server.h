// The composition root: store, job engine, services and listener, built in this order and taken
// down in reverse.
//
//   Start: address free? -> store -> engine -> scheduler -> executors -> services -> listener
//   Stop:  NOT_SERVING -> streams end, calls get `drain` -> scheduler and engine stop, its jobs go
//   back to PENDING -> store closes
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "grpcpp/channel.h"
#include "grpcpp/support/channel_arguments.h"
#include "server/jobs/runner.h"
#include "server/server_options.h"

namespace truepose::server {

class Server {
 public:
  // Serves when it returns. Jobs that an earlier server left behind are taken up.
  // @param runners what jobs run; calibration_runner.h makes the real ones.
  // @returns kInvalidArgument for options; kUnavailable when the address is taken; the store's
  // status when the database
  //   can't be used (server/store/store.h). On failure nothing is left behind.
  static absl::StatusOr<std::unique_ptr<Server>> Start(const ServerOptions& options,
                                                       jobs::Runners runners);
  // Stop().
  ~Server();

  // As clients write it, with the port that was taken.
  const std::string& address() const;
  std::shared_ptr<grpc::Channel> InProcessChannel(const grpc::ChannelArguments& arguments);

  // The file with the one-time secret for the first admin; "" when none is due.
  std::string bootstrap_file() const;

  // Drains and closes, at most `drain` longer than the job that is asked to end takes. May be
  // called again.
  void Stop();

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace truepose::server
