// Compensation tables over a real server: from an activation to bytes that fit their digest, as an
// agent sees it.
#include <grpcpp/grpcpp.h>

#include <thread>

#include "absl/strings/str_cat.h"
#include "client/download.h"
#include "client/wait_for_job.h"
#include "client/watch.h"
#include "core/base/fault.h"
#include "server/store/checksum.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose {
namespace {

using testing::HasCode;
using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

class TableOverServer : public testing::ServerFixture {
 protected:
  // robots/arm with an approved calibration.
  void SetUp() override {
    Import(NewClient(), "arm", Uuid(1), MeasuringSession(100, 1));
    const client::Client client = NewClient();
    ASSERT_THAT(client.CreateCalibrationJob(JobRequest(Uuid(7), "arm", Uuid(1))), IsOk());
    ASSERT_THAT(client::WaitForJob(client, absl::StrCat("jobs/", Uuid(7))), IsOk());
    v1::ApproveCalibrationRequest approve;
    approve.set_name("robots/arm/calibrations/1");
    approve.set_reason("looked at");
    ASSERT_THAT(client.ApproveCalibration(approve), IsOk());
  }

  void SetSpec() {
    v1::UpdateRobotRequest request;
    request.mutable_robot()->set_name("robots/arm");
    request.mutable_robot()->mutable_table_spec()->set_seed(3);
    request.mutable_update_mask()->add_paths("table_spec");
    v1::Robot robot;
    ASSERT_THAT(NewClient().CallMethod("truepose.v1.RobotService/UpdateRobot", request, &robot),
                IsOk());
  }
  void Activate() {
    v1::ActivateCalibrationRequest activate;
    activate.set_name("robots/arm/calibrations/1");
    ASSERT_THAT(NewClient().ActivateCalibration(activate), IsOk());
  }

  // What an agent of robots/arm learns: the table that the robot names, once it is there.
  v1::CompensationTable WatchUntilReady() {
    std::map<std::string, v1::CompensationTable> tables;
    std::string named;
    v1::WatchRequest request;
    request.set_robot("robots/arm");
    request.add_kinds(v1::KIND_ROBOT);
    request.add_kinds(v1::KIND_COMPENSATION_TABLE);
    const absl::Status status = NewClient().Watch(request, [&](const v1::WatchResponse& response) {
      for (const v1::WatchEvent& event : response.events()) {
        if (event.has_compensation_table()) tables[event.name()] = event.compensation_table();
        if (event.has_robot()) named = event.robot().active_compensation_table();
      }
      return named.empty() || !tables.contains(named);
    });
    EXPECT_THAT(status, IsOk());
    return tables[named];
  }

  v1::CreateCompensationTableRequest Request(int number, uint64_t seed) {
    v1::CreateCompensationTableRequest request;
    request.set_parent("robots/arm");
    request.set_compensation_table_id(Uuid(number));
    request.mutable_compensation_table()->set_calibration("robots/arm/calibrations/1");
    request.mutable_compensation_table()->mutable_spec()->set_seed(seed);
    return request;
  }
};

// Would catch a table that an agent does not hear of, whose digest is not that of its bytes, or
// that a restart loses.
TEST_F(TableOverServer, AnAgentHearsOfItAndFetchesIt) {
  SetSpec();
  v1::CompensationTable table;
  std::thread agent([&] { table = WatchUntilReady(); });
  Activate();
  agent.join();
  EXPECT_EQ(table.state(), v1::TABLE_READY);
  EXPECT_EQ(table.calibration(), "robots/arm/calibrations/1");
  Restart();
  const auto bytes = client::Download(NewClient(), table.name(), {.sha256 = table.sha256()});
  ASSERT_THAT(bytes, IsOk());
  EXPECT_EQ(store::Sha256Hex(*bytes), table.sha256());
  EXPECT_EQ(static_cast<int64_t>(bytes->size()), table.size_bytes());
  v1::GetActiveCompensationTableRequest active;
  active.set_robot("robots/arm");
  EXPECT_EQ(NewClient().GetActiveCompensationTable(active)->name(), table.name());
  EXPECT_EQ(WatchUntilReady().name(), table.name()) << "also who comes later, by the snapshot";
}

// Would catch a download that takes other bytes than those that were asked for.
TEST_F(TableOverServer, OtherBytesThanAskedForAreRefused) {
  const auto table = NewClient().CreateCompensationTable(Request(21, 1));
  ASSERT_THAT(table, IsOk());
  ASSERT_THAT(client::WaitForJob(NewClient(), table->job()), IsOk());
  EXPECT_THAT(client::Download(NewClient(), table->name(), {.sha256 = store::Sha256Hex("another")}),
              HasCode(absl::StatusCode::kAborted));
}

// Would catch a table that can't be found by the digest of a file that somebody has.
TEST_F(TableOverServer, IsFoundByItsDigest) {
  for (const int number : {1, 2}) {
    const auto table = NewClient().CreateCompensationTable(Request(20 + number, number));
    ASSERT_THAT(table, IsOk());
    ASSERT_THAT(client::WaitForJob(NewClient(), table->job()), IsOk());
  }
  v1::ListCompensationTablesRequest list;
  const auto all = NewClient().ListCompensationTables(list);
  ASSERT_THAT(all, IsOk());
  ASSERT_EQ(all->compensation_tables_size(), 2);
  list.set_filter(absl::StrCat("sha256 = \"", all->compensation_tables(1).sha256(), "\""));
  const auto found = NewClient().ListCompensationTables(list);
  ASSERT_THAT(found, IsOk());
  ASSERT_EQ(found->compensation_tables_size(), 1);
  EXPECT_EQ(found->compensation_tables(0).name(), all->compensation_tables(1).name());
}

// Would catch a spec whose table is too large, which only the job of the next activation finds out.
TEST_F(TableOverServer, ASpecTooFineForItsSizeIsRefusedWhenItIsSet) {
  runner_.estimate_table =
      [](const v1::CompensationTableInput& input) -> absl::StatusOr<v1::CompensationTableEstimate> {
    EXPECT_EQ(input.calibration().name(), "robots/arm/calibrations/1");
    FaultList faults;
    faults.Add("largest_bytes", "a table of 900 MB", "at most 64 MB");
    faults.Add("calibration.report.verdict", "of another concern", "no fault of the spec");
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  };
  Restart();
  Activate();
  v1::UpdateRobotRequest request;
  request.mutable_robot()->set_name("robots/arm");
  request.mutable_robot()->mutable_table_spec()->set_position_tolerance_m(1e-7);
  request.mutable_update_mask()->add_paths("table_spec");
  v1::Robot robot;
  EXPECT_THAT(NewClient().CallMethod("truepose.v1.RobotService/UpdateRobot", request, &robot),
              testing::HasFaultsAt(std::vector<std::string>{"robot.table_spec.largest_bytes"}));
  EXPECT_EQ(NewClient().ListCompensationTables({})->compensation_tables_size(), 0);
}

// Would catch an estimate that builds, or is not given.
TEST_F(TableOverServer, ADryRunEstimates) {
  v1::CreateCompensationTableRequest request = Request(21, 1);
  request.set_validate_only(true);
  const auto table = NewClient().CreateCompensationTable(request);
  ASSERT_THAT(table, IsOk());
  EXPECT_EQ(table->estimate().size_bytes(), 600'000);
  EXPECT_EQ(NewClient().ListCompensationTables({})->compensation_tables_size(), 0);
}

// Would catch a build that holds its robot for ever, and a table that says nothing of its end.
TEST_F(TableOverServer, ACancelledOneSaysSo) {
  runner_.build_table = [](const v1::CompensationTableInput&,
                           const jobs::RunnerHooks& hooks) -> absl::StatusOr<jobs::BuiltTable> {
    while (!hooks.is_cancelled()) std::this_thread::yield();
    return absl::CancelledError("asked to end");
  };
  Restart();
  const auto table = NewClient().CreateCompensationTable(Request(21, 1));
  ASSERT_THAT(table, IsOk());
  v1::CancelCalibrationJobRequest cancel;
  cancel.set_name(table->job());
  ASSERT_THAT(NewClient().CancelCalibrationJob(cancel), IsOk());
  EXPECT_EQ(client::WaitForJob(NewClient(), table->job())->state(), v1::CANCELLED);
  v1::GetCompensationTableRequest get;
  get.set_name(table->name());
  const auto ended = NewClient().GetCompensationTable(get);
  EXPECT_EQ(ended->state(), v1::TABLE_FAILED);
  EXPECT_EQ(ended->error().message(), "its job was cancelled");
}

}  // namespace
}  // namespace truepose
