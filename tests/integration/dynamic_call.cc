#include "tests/integration/dynamic_call.h"

#include <chrono>
#include <fstream>
#include <future>

#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.pb.h"
#include "google/protobuf/dynamic_message.h"
#include "google/protobuf/text_format.h"
#include "grpcpp/generic/generic_stub.h"
#include "gtest/gtest.h"

namespace truepose::testing {

namespace pb = google::protobuf;

namespace {

// The proto files as they stand in the tree, whatever is linked here.
struct Protos {
  Protos() {
    std::ifstream file(TRUEPOSE_DESCRIPTORS, std::ios::binary);
    EXPECT_TRUE(files.ParseFromIstream(&file));
    for (const pb::FileDescriptorProto& one : files.file()) pool.BuildFile(one);
  }

  pb::FileDescriptorSet files;  // each after its imports
  pb::DescriptorPool pool;
  pb::DynamicMessageFactory messages{&pool};
};

Protos& TheProtos() {
  static auto& protos = *new Protos();
  return protos;
}

}  // namespace

std::vector<const pb::MethodDescriptor*> AllMethods() {
  std::vector<const pb::MethodDescriptor*> methods;
  for (const pb::FileDescriptorProto& one : TheProtos().files.file()) {
    const pb::FileDescriptor* file = TheProtos().pool.FindFileByName(one.name());
    for (int s = 0; s < file->service_count(); ++s)
      for (int m = 0; m < file->service(s)->method_count(); ++m)
        methods.push_back(file->service(s)->method(m));
  }
  return methods;
}

std::unique_ptr<pb::Message> ParseRequest(const pb::MethodDescriptor& method,
                                          const std::string& text) {
  std::unique_ptr<pb::Message> request(
      TheProtos().messages.GetPrototype(method.input_type())->New());
  EXPECT_TRUE(pb::TextFormat::ParseFromString(text, request.get()))
      << method.full_name() << ": " << text;
  return request;
}

DynamicReply CallMethod(const std::shared_ptr<grpc::Channel>& channel,
                        const pb::MethodDescriptor& method, const pb::Message& request) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_wait_for_ready(true);
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
  const grpc::Slice slice(request.SerializeAsString());
  const grpc::ByteBuffer sent(&slice, 1);
  grpc::ByteBuffer received;
  std::promise<grpc::Status> status;
  stub.UnaryCall(&context, absl::StrCat("/", method.service()->full_name(), "/", method.name()), {},
                 &sent, &received, [&](grpc::Status ended) { status.set_value(std::move(ended)); });
  DynamicReply reply{status.get_future().get(), ""};
  grpc::Slice whole;
  if (reply.status.ok() && received.DumpToSingleSlice(&whole).ok())
    reply.bytes.assign(reinterpret_cast<const char*>(whole.begin()), whole.size());
  return reply;
}

}  // namespace truepose::testing
