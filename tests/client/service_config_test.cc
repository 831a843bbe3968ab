#include "client/service_config.h"

#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"
#include "gtest/gtest.h"
#include "truepose/v1/services.pb.h"

namespace truepose::client {
namespace {

// What may not be repeated blindly: see service_config.h. A change of what is there is one, since
// its etag or state may be another after the first time.
bool IsRepeatable(const google::protobuf::MethodDescriptor& method) {
  for (const char* change :
       {"Update", "Delete", "Undelete", "Approve", "Reject", "Activate", "RollBack"}) {
    if (absl::StartsWith(method.name(), change)) return false;
  }
  return !method.client_streaming() && !method.server_streaming() &&
         method.name() != "CreateNominalRevision";
}

std::string Entry(const google::protobuf::MethodDescriptor& method) {
  return absl::StrCat(R"({"service":")", method.service()->full_name(), R"(","method":")",
                      method.name(), R"("})");
}

// Would catch a new RPC nobody thought about, a misspelt one, and one that is repeated although it
// must not be.
TEST(ServiceConfigTest, NamesExactlyTheRepeatableCalls) {
  const std::string config = ServiceConfigJson();
  const auto* file = v1::CreateRobotRequest::descriptor()->file();
  size_t entries = 0;
  for (int s = 0; s < file->service_count(); ++s) {
    for (int m = 0; m < file->service(s)->method_count(); ++m) {
      const auto& method = *file->service(s)->method(m);
      const bool named = config.find(Entry(method)) != std::string::npos;
      EXPECT_EQ(named, IsRepeatable(method)) << method.full_name();
      entries += named ? 1 : 0;
    }
  }
  size_t found = 0;
  for (size_t at = config.find("{\"service\""); at != std::string::npos;
       at = config.find("{\"service\"", at + 1))
    ++found;
  EXPECT_EQ(found, entries) << "an entry names no RPC: " << config;
}

}  // namespace
}  // namespace truepose::client
