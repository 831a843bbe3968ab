#include "server/auth/access_table.h"

#include <filesystem>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"
#include "gtest/gtest.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/admin_services.pb.h"
#include "truepose/v1/compensation_table_services.pb.h"
#include "truepose/v1/download_services.pb.h"
#include "truepose/v1/plant_services.pb.h"
#include "truepose/v1/recalibration_services.pb.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/watch_services.pb.h"

namespace truepose::auth {
namespace {

using testing::HasCode;
using testing::IsOk;

// A file's descriptors are linked when something of it is used: of each file with services.
bool LinkAllServices() {
  const void* const volatile used[] = {
      &descriptor_table_truepose_2fv1_2fservices_2eproto,
      &descriptor_table_truepose_2fv1_2fplant_5fservices_2eproto,
      &descriptor_table_truepose_2fv1_2fcompensation_5ftable_5fservices_2eproto,
      &descriptor_table_truepose_2fv1_2fdownload_5fservices_2eproto,
      &descriptor_table_truepose_2fv1_2fwatch_5fservices_2eproto,
      &descriptor_table_truepose_2fv1_2frecalibration_5fservices_2eproto,
      &descriptor_table_truepose_2fv1_2fadmin_5fservices_2eproto,
  };
  return used[0] != nullptr;
}

// "truepose.v1.RobotService/GetRobot" of every RPC of every file with services in
// proto/truepose/v1.
std::set<std::string> AllRpcs() {
  EXPECT_TRUE(LinkAllServices());
  std::set<std::string> rpcs;
  const auto folder = std::filesystem::path(TRUEPOSE_SOURCE_DIR) / "proto/truepose/v1";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!absl::EndsWith(name, "services.proto")) continue;
    const auto* file = google::protobuf::DescriptorPool::generated_pool()->FindFileByName(
        absl::StrCat("truepose/v1/", name));
    if (file == nullptr) {
      ADD_FAILURE() << name << ": name its table in LinkAllServices";
      continue;
    }
    for (int s = 0; s < file->service_count(); ++s) {
      const auto* service = file->service(s);
      for (int m = 0; m < service->method_count(); ++m)
        rpcs.insert(absl::StrCat(service->full_name(), "/", service->method(m)->name()));
    }
  }
  return rpcs;
}

std::string NameOf(const AccessRow& row) {
  return absl::StrCat(std::string(row.service), "/", std::string(row.method));
}

// Would catch a new RPC that nobody thought about: without a row it is closed, and here it is
// named.
TEST(AccessTableTest, EveryRpcHasARow) {
  const std::set<std::string> rpcs = AllRpcs();
  ASSERT_GT(rpcs.size(), 90u) << "the services were not found";
  std::set<std::string> rows, methods;
  for (const AccessRow& row : AccessTable()) {
    EXPECT_TRUE(rows.insert(NameOf(row)).second) << "two rows of " << NameOf(row);
    EXPECT_TRUE(methods.emplace(row.method).second) << "bindings ask by name: " << row.method;
  }
  for (const std::string& rpc : rpcs) EXPECT_TRUE(rows.contains(rpc)) << "no row: " << rpc;
  for (const std::string& row : rows) EXPECT_TRUE(rpcs.contains(row)) << "no RPC: " << row;
}

// Would catch an RPC that was opened by a slip: all that may be called without a token, by admins
// only or by persons only is listed here a second time.
TEST(AccessTableTest, ExceptionsAreTheseAlone) {
  std::set<std::string> everybody, admin, person;
  for (const AccessRow& row : AccessTable()) {
    if (row.access == Access::kEverybody) everybody.emplace(row.method);
    if (row.access == Access::kAdmin) admin.emplace(row.method);
    if (row.access == Access::kPerson) person.emplace(row.method);
  }
  EXPECT_EQ(everybody, std::set<std::string>{"Bootstrap"});
  EXPECT_EQ(admin, (std::set<std::string>{"CreateToken", "ListTokens", "RevokeToken"}));
  EXPECT_EQ(person, (std::set<std::string>{"ApproveCalibration", "RejectCalibration",
                                           "ActivateCalibration", "RollBackCalibration"}));
}

Caller Person() { return {.principal = "anna", .is_admin = false, .is_local_dev = false}; }

Caller Machine() {
  return {.principal = "cell-7", .is_machine = true, .is_admin = false, .is_local_dev = false};
}

// Would catch levels that are swapped, and a call without a row that is let through.
TEST(AccessTableTest, WhoMayWhat) {
  EXPECT_THAT(CheckAccess(Access::kToken, Machine()), IsOk());
  EXPECT_THAT(CheckAccess(Access::kPerson, Person()), IsOk());
  EXPECT_THAT(CheckAccess(Access::kAdmin, Caller()), IsOk()) << "local-dev is admin";
  const auto denied = HasCode(absl::StatusCode::kPermissionDenied);
  EXPECT_THAT(CheckAccess(Access::kPerson, Machine()), denied);
  EXPECT_THAT(CheckAccess(Access::kAdmin, Person()), denied);
  EXPECT_THAT(CheckAccess(std::nullopt, Caller()), denied);
  EXPECT_EQ(AccessTo("GetRobot"), Access::kToken);
  EXPECT_EQ(AccessTo("GetRobots"), std::nullopt);
}

}  // namespace
}  // namespace truepose::auth
