// An address becomes a channel.
#pragma once

#include <memory>
#include <string>

#include "grpcpp/channel.h"
#include "grpcpp/support/channel_arguments.h"

namespace truepose::client {

// Message sizes, keepalive, the bound of error details, and the service config. For channels within
// the process too.
grpc::ChannelArguments ChannelArguments();

// Plaintext: for a unix socket and for loopback, where trueposed listens. Connects at the first
// call.
std::shared_ptr<grpc::Channel> MakeChannel(const std::string& address);

}  // namespace truepose::client
