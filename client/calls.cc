// Unary calls by their names.
#include <chrono>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "client/client.h"
#include "client/client_impl.h"
#include "client/status.h"
#include "client/uuid.h"
#include "google/protobuf/descriptor.h"
#include "grpcpp/completion_queue.h"
#include "grpcpp/generic/generic_stub.h"

namespace truepose::client {
namespace {

using google::protobuf::Message;

// A copy with an id where the request can have one and has none.
std::unique_ptr<Message> WithRequestId(const Message& request) {
  std::unique_ptr<Message> sent(request.New());
  sent->CopyFrom(request);
  const auto* field = sent->GetDescriptor()->FindFieldByName("request_id");
  if (field == nullptr) return sent;
  const auto* reflection = sent->GetReflection();
  if (reflection->GetString(*sent, field).empty()) {
    reflection->SetString(sent.get(), field, RandomUuid());
  }
  return sent;
}

}  // namespace

absl::Status Client::CallMethod(const std::string& method, const Message& request,
                                Message* response) const {
  const std::unique_ptr<Message> sent = WithRequestId(request);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + impl_->options.call_timeout);
  PrepareContext(context, impl_->options);
  grpc::TemplatedGenericStub<Message, Message> stub(impl_->channel);
  grpc::CompletionQueue queue;
  const auto call = stub.PrepareUnaryCall(&context, absl::StrCat("/", method), *sent, &queue);
  call->StartCall();
  grpc::Status status;
  call->Finish(response, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  return FromGrpcStatus(status, impl_->address);
}

}  // namespace truepose::client
