#include "client/service_config.h"

#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"
#include "gtest/gtest.h"
#include "truepose/v1/admin_services.pb.h"
#include "truepose/v1/compensation_table_services.pb.h"
#include "truepose/v1/download_services.pb.h"
#include "truepose/v1/plant_services.pb.h"
#include "truepose/v1/recalibration_services.pb.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/watch_services.pb.h"

namespace truepose::client {
namespace {

using google::protobuf::MethodDescriptor;

// Its own secret is used up by the first call.
bool IsForOnce(const MethodDescriptor& method) { return method.name() == "Bootstrap"; }

bool IsRepeatable(const MethodDescriptor& method) {
  return !method.client_streaming() && !method.server_streaming() && !IsForOnce(method);
}

std::string Entry(const MethodDescriptor& method) {
  return absl::StrCat(R"({"service":")", method.service()->full_name(), R"(","method":")",
                      method.name(), R"("})");
}

// By itself, or with all methods of its service.
bool IsNamed(const std::string& config, const MethodDescriptor& method) {
  const std::string whole = absl::StrCat(R"({"service":")", method.service()->full_name(), R"("})");
  return absl::StrContains(config, Entry(method)) || absl::StrContains(config, whole);
}

// What only reads, or says how something is to be, needs no id.
bool IsSafeToRepeat(const MethodDescriptor& method) {
  for (const char* reads :
       {"Get", "List", "Evaluate", "Compensate", "Compare", "Revoke", "ReportAgent"}) {
    if (absl::StartsWith(method.name(), reads)) return true;
  }
  return method.input_type()->FindFieldByName("request_id") != nullptr;
}

// Files of services hold nothing else that would link them.
const google::protobuf::internal::DescriptorTable* const kTables[] = {
    &descriptor_table_truepose_2fv1_2fservices_2eproto,
    &descriptor_table_truepose_2fv1_2fplant_5fservices_2eproto,
    &descriptor_table_truepose_2fv1_2frecalibration_5fservices_2eproto,
    &descriptor_table_truepose_2fv1_2fcompensation_5ftable_5fservices_2eproto,
    &descriptor_table_truepose_2fv1_2fdownload_5fservices_2eproto,
    &descriptor_table_truepose_2fv1_2fwatch_5fservices_2eproto,
    &descriptor_table_truepose_2fv1_2fadmin_5fservices_2eproto};

std::vector<const google::protobuf::FileDescriptor*> Files() {
  std::vector<const google::protobuf::FileDescriptor*> files;
  for (const auto* table : kTables) {
    files.push_back(
        google::protobuf::DescriptorPool::generated_pool()->FindFileByName(table->filename));
  }
  return files;
}

// Would catch a new RPC nobody thought about, a misspelt one, and a stream that is repeated as a
// whole.
TEST(ServiceConfigTest, NamesExactlyTheUnaryCalls) {
  const std::string config = ServiceConfigJson();
  size_t found = 0;
  for (const auto* file : Files()) {
    for (int s = 0; s < file->service_count(); ++s) {
      for (int m = 0; m < file->service(s)->method_count(); ++m) {
        const MethodDescriptor& method = *file->service(s)->method(m);
        EXPECT_EQ(IsNamed(config, method), IsRepeatable(method)) << method.full_name();
        found += absl::StrContains(config, Entry(method)) ? 1 : 0;
      }
    }
  }
  size_t entries = 0;
  for (size_t at = config.find("\"method\""); at != std::string::npos;
       at = config.find("\"method\"", at + 1))
    ++entries;
  EXPECT_EQ(found, entries) << "an entry names no RPC: " << config;
}

// Would catch a change without a request id, which a repeat would make twice.
TEST(ServiceConfigTest, WhatIsRepeatedHasOneEffect) {
  for (const auto* file : Files()) {
    for (int s = 0; s < file->service_count(); ++s) {
      for (int m = 0; m < file->service(s)->method_count(); ++m) {
        const MethodDescriptor& method = *file->service(s)->method(m);
        EXPECT_TRUE(!IsRepeatable(method) || IsSafeToRepeat(method)) << method.full_name();
      }
    }
  }
}

}  // namespace
}  // namespace truepose::client
