// Calls of any RPC by its descriptor, so that a test can cover what it doesn't know by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "google/protobuf/descriptor.h"
#include "google/protobuf/message.h"
#include "grpcpp/channel.h"
#include "grpcpp/support/status.h"

namespace truepose::testing {

// Every RPC of the proto files in the tree.
std::vector<const google::protobuf::MethodDescriptor*> AllMethods();

struct DynamicReply {
  grpc::Status status;
  std::string bytes;  // of the reply
};

// A request of the method from its text form. A text that is no such request fails the test.
std::unique_ptr<google::protobuf::Message> ParseRequest(
    const google::protobuf::MethodDescriptor& method, const std::string& text);

// Waits for the answer, 60 s at most. For methods without streams.
DynamicReply CallMethod(const std::shared_ptr<grpc::Channel>& channel,
                        const google::protobuf::MethodDescriptor& method,
                        const google::protobuf::Message& request);

}  // namespace truepose::testing
