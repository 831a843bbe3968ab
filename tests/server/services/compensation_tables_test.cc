// Compensation tables through their handlers: which calibration may have one, what is built by
// itself, and which one is to be applied.
#include "server/services/compensation_tables.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/services/download.h"
#include "server/services/release.h"
#include "server/services/robots.h"
#include "server/services/standard.h"
#include "server/services/table_jobs.h"
#include "server/store/calibrations.h"
#include "server/store/checksum.h"
#include "server/store/compensation_tables.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/robots.h"
#include "server/store/sql/query.h"
#include "server/store/table_files.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::IsOk;
using testing::kJob1;
using testing::kJob2;
using testing::kSession1;
using testing::kSession2;
using Fields = std::vector<std::string>;

constexpr char kFirst[] = "robots/ur10/calibrations/1";
constexpr char kSecond[] = "robots/ur10/calibrations/2";
constexpr char kTable1[] = "00000000-0000-4000-8000-0000000000a1";
constexpr char kTable2[] = "00000000-0000-4000-8000-0000000000a2";

class TablesTest : public HandlerTest {
 protected:
  TablesTest() {
    AddRobot("ur10");
    AddSimulatedSession(kSession1, "ur10", testing::kCalibrationPoses);
    AddSimulatedSession(kSession2, "ur10", testing::kCalibrationPoses);
    AddCalibration("ur10", kSession1, kJob1);
    AddCalibration("ur10", kSession2, kJob2);
  }

  CallContext AsAnna() {
    CallContext context = call();
    context.caller = {
        .principal = "anna", .is_machine = false, .is_admin = true, .is_local_dev = false};
    return context;
  }

  static v1::CreateCompensationTableRequest Request(const std::string& id,
                                                    const std::string& calibration,
                                                    uint64_t seed = 1) {
    v1::CreateCompensationTableRequest request;
    request.set_parent("robots/ur10");
    request.set_compensation_table_id(id);
    request.mutable_compensation_table()->set_calibration(calibration);
    request.mutable_compensation_table()->mutable_spec()->set_seed(seed);
    return request;
  }
  absl::StatusOr<v1::CompensationTable> Create(const std::string& id,
                                               const std::string& calibration, uint64_t seed = 1) {
    return CreateCompensationTable(AsAnna(), Request(id, calibration, seed));
  }

  void Approve(const std::string& name) {
    v1::ApproveCalibrationRequest request;
    request.set_name(name);
    request.set_reason("looked at");
    ASSERT_THAT(ApproveCalibration(AsAnna(), request), IsOk());
  }
  void Activate(const std::string& name) {
    v1::ActivateCalibrationRequest request;
    request.set_name(name);
    ASSERT_THAT(ActivateCalibration(AsAnna(), request), IsOk());
  }
  void RollBack() {
    v1::RollBackCalibrationRequest request;
    request.set_robot("robots/ur10");
    ASSERT_THAT(RollBackCalibration(AsAnna(), request), IsOk());
  }
  absl::StatusOr<v1::Robot> SetSpec(const v1::CompensationTableSpec* spec) {
    v1::UpdateRobotRequest request;
    request.mutable_robot()->set_name("robots/ur10");
    if (spec != nullptr) *request.mutable_robot()->mutable_table_spec() = *spec;
    request.mutable_update_mask()->add_paths("table_spec");
    return UpdateRobot(AsAnna(), request);
  }
  void SetSeed(uint64_t seed) {
    v1::CompensationTableSpec spec;
    spec.set_seed(seed);
    ASSERT_THAT(SetSpec(&spec), IsOk());
  }

  v1::Robot TheRobot() {
    v1::GetRobotRequest request;
    request.set_name("robots/ur10");
    return *GetRobot(call(), request);
  }
  std::vector<v1::CompensationTable> Tables() {
    std::vector<v1::CompensationTable> tables;
    const auto read = store().Read([&](store::Snapshot& snapshot) -> absl::Status {
      TRUEPOSE_ASSIGN_OR_RETURN(
          const auto jobs, store::ListJobs(snapshot, "robots/ur10", {.size = 100, .token = ""}));
      for (const v1::CalibrationJob& job : jobs.items) {
        if (job.compensation_table().empty()) continue;
        TRUEPOSE_ASSIGN_OR_RETURN(auto table, store::GetTable(snapshot, job.compensation_table()));
        tables.insert(tables.begin(), std::move(table));
      }
      return absl::OkStatus();
    });
    EXPECT_THAT(read, IsOk());
    return tables;
  }
  absl::StatusOr<v1::CompensationTable> ActiveTable() {
    v1::GetActiveCompensationTableRequest request;
    request.set_robot("robots/ur10");
    return GetActiveCompensationTable(call(), request);
  }

  // Ends a table's job as the engine does, with this file.
  void Finish(const v1::CompensationTable& table, const std::string& bytes) {
    ASSERT_THAT(store().Write([&](store::Transaction& transaction) -> absl::Status {
      TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store::GetJob(transaction, table.job()));
      TRUEPOSE_RETURN_IF_ERROR(
          store::FinishTable(transaction, job, {bytes, store::Sha256Hex(bytes), {}}).status());
      job.set_state(v1::SUCCEEDED);
      TRUEPOSE_RETURN_IF_ERROR(store::UpdateJob(transaction, job, 0));
      return EndTableJob(transaction, job);
    }),
                IsOk());
  }
  void End(const v1::CompensationTable& table, v1::JobState state, const std::string& message) {
    ASSERT_THAT(store().Write([&](store::Transaction& transaction) -> absl::Status {
      TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store::GetJob(transaction, table.job()));
      job.set_state(state);
      job.mutable_error()->set_message(message);
      TRUEPOSE_RETURN_IF_ERROR(store::UpdateJob(transaction, job, 0));
      return EndTableJob(transaction, job);
    }),
                IsOk());
  }
};

// Would catch a table of something that nobody has found good.
TEST_F(TablesTest, ADraftNeedsToBeAskedFor) {
  EXPECT_THAT(Create(kTable1, kFirst), HasCode(absl::StatusCode::kFailedPrecondition));
  v1::CreateCompensationTableRequest request = Request(kTable1, kFirst);
  request.set_allow_draft(true);
  const auto table = CreateCompensationTable(AsAnna(), request);
  ASSERT_THAT(table, IsOk());
  EXPECT_EQ(table->state(), v1::TABLE_BUILDING);
  EXPECT_EQ(table->job(), store::JobName(kTable1));
  EXPECT_EQ(table->created_by(), "anna");
  EXPECT_EQ(table->calibration_digest().size(), 64u);
  EXPECT_EQ(table->input_digest().size(), 64u);
}

// Would catch compensation by what was rejected, or is known to make the robot worse.
TEST_F(TablesTest, NeitherRejectedNorDoNotApply) {
  v1::RejectCalibrationRequest reject;
  reject.set_name(kFirst);
  reject.set_reason("too few poses");
  ASSERT_THAT(RejectCalibration(AsAnna(), reject), IsOk());
  v1::CreateCompensationTableRequest request = Request(kTable1, kFirst);
  request.set_allow_draft(true);
  EXPECT_THAT(CreateCompensationTable(AsAnna(), request),
              HasCode(absl::StatusCode::kFailedPrecondition));
  v1::Calibration bad;
  bad.set_state(v1::APPROVED);
  EXPECT_THAT(CheckMayHaveTable(bad, false), IsOk());
  bad.mutable_report()->set_verdict("do_not_apply");
  EXPECT_THAT(CheckMayHaveTable(bad, true), HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch faults that are told one by one, or under the names of another message.
TEST_F(TablesTest, EveryFaultOfTheRequest) {
  EXPECT_THAT(CreateCompensationTable(AsAnna(), {}),
              HasFaultsAt(Fields{"parent", "compensation_table_id"}));
  Approve(kFirst);
  v1::CreateCompensationTableRequest request = Request(kTable1, kFirst);
  auto& spec = *request.mutable_compensation_table()->mutable_spec();
  spec.set_verification_points(3);
  spec.mutable_joint_ranges()->add_joints()->set_upper(1.0);
  EXPECT_THAT(CreateCompensationTable(AsAnna(), request),
              HasFaultsAt(Fields{"compensation_table.spec.verification_points",
                                 "compensation_table.spec.joint_ranges.joints"}));
  request = Request(kTable1, "robots/other/calibrations/1");
  EXPECT_THAT(CreateCompensationTable(AsAnna(), request),
              HasFaultsAt(Fields{"compensation_table.calibration"}));
}

// Would catch a table that is built twice, and one that is taken for another.
TEST_F(TablesTest, EqualInputIsBuiltOnce) {
  Approve(kFirst);
  const auto first = Create(kTable1, kFirst);
  ASSERT_THAT(first, IsOk());
  EXPECT_EQ(Create(kTable1, kFirst)->SerializeAsString(), first->SerializeAsString()) << "a repeat";
  EXPECT_EQ(Create(kTable2, kFirst)->name(), first->name()) << "the one that is BUILDING";
  EXPECT_THAT(Create(kTable1, kFirst, 2), HasCode(absl::StatusCode::kAlreadyExists));
  EXPECT_EQ(Create(kTable2, kFirst, 2)->name(), store::CompensationTableName("ur10", kTable2));
  EXPECT_EQ(Tables().size(), 2u);
}

// Would catch a FAILED table that blocks every further attempt.
TEST_F(TablesTest, AFailedOneIsTriedAgainByANewOne) {
  Approve(kFirst);
  const auto first = Create(kTable1, kFirst);
  End(*first, v1::FAILED, "larger than largest_bytes");
  const auto failed = Tables().front();
  EXPECT_EQ(failed.state(), v1::TABLE_FAILED);
  EXPECT_EQ(failed.error().message(), "larger than largest_bytes");
  EXPECT_EQ(Create(kTable2, kFirst)->state(), v1::TABLE_BUILDING);
  End(Tables().back(), v1::CANCELLED, "");
  EXPECT_EQ(Tables().back().error().code(), static_cast<int>(absl::StatusCode::kCancelled));
}

// Would catch an activation without its table, and one in the name of somebody else.
TEST_F(TablesTest, FollowsTheActivationOfARobotWithASpec) {
  SetSeed(5);
  Approve(kFirst);
  EXPECT_TRUE(Tables().empty()) << "nothing is active";
  Activate(kFirst);
  ASSERT_EQ(Tables().size(), 1u);
  EXPECT_EQ(Tables()[0].calibration(), kFirst);
  EXPECT_EQ(Tables()[0].spec().seed(), 5u);
  EXPECT_EQ(Tables()[0].created_by(), "anna");
  EXPECT_THAT(ActiveTable(), HasCode(absl::StatusCode::kNotFound));
  Finish(Tables()[0], "one");
  EXPECT_EQ(TheRobot().active_compensation_table(), Tables()[0].name());
  EXPECT_EQ(ActiveTable()->sha256(), store::Sha256Hex("one"));
}

// Would catch a robot that goes on with the table of a calibration that no longer acts, and a table
// that is built again though it is there.
TEST_F(TablesTest, ARollBackFindsTheTableThatIsThere) {
  SetSeed(5);
  Approve(kFirst);
  Activate(kFirst);
  Finish(Tables()[0], "one");
  Approve(kSecond);
  Activate(kSecond);
  ASSERT_EQ(Tables().size(), 2u);
  EXPECT_EQ(TheRobot().active_compensation_table(), "") << "not that of the one before";
  Finish(Tables()[1], "two");
  EXPECT_EQ(ActiveTable()->sha256(), store::Sha256Hex("two"));
  RollBack();
  EXPECT_EQ(ActiveTable()->sha256(), store::Sha256Hex("one")) << "in the same commit";
  EXPECT_EQ(Tables().size(), 2u);
}

// Would catch a new spec that waits for the next activation.
TEST_F(TablesTest, FollowsAChangeOfTheSpec) {
  Approve(kFirst);
  Activate(kFirst);
  EXPECT_TRUE(Tables().empty()) << "no spec, no table";
  SetSeed(5);
  ASSERT_EQ(Tables().size(), 1u);
  Finish(Tables()[0], "one");
  SetSeed(6);
  ASSERT_EQ(Tables().size(), 2u);
  EXPECT_EQ(ActiveTable()->sha256(), store::Sha256Hex("one")) << "until the new one is READY";
  Finish(Tables()[1], "two");
  EXPECT_EQ(ActiveTable()->sha256(), store::Sha256Hex("two"));
  SetSeed(5);
  EXPECT_EQ(ActiveTable()->sha256(), store::Sha256Hex("one")) << "of that spec, though older";
  ASSERT_THAT(SetSpec(nullptr), IsOk());
  EXPECT_FALSE(TheRobot().has_table_spec());
  EXPECT_EQ(Tables().size(), 2u);
}

// Would catch a robot whose spec was stored when an edge at 0 was written as nothing, and which
// gets no table any more.
TEST_F(TablesTest, AStoredEdgeThatIsMissingIsZero) {
  const auto spec = testing::Parse<v1::CompensationTableSpec>(R"pb(
    box {
      min_x_m: -0.6
      max_x_m: -0.4
      min_y_m: -0.2
      min_z_m: 0.2
      max_z_m: 0.4
      reference_joints: [ 0, -1, 1.5, -2, -1.57, 0 ]
    })pb");
  ASSERT_THAT(store().Write([&](store::Transaction& transaction) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, store::GetRobot(transaction, "robots/ur10"));
    *robot.mutable_table_spec() = spec;
    return store::PutRobot(transaction, robot).status();
  }),
              IsOk());
  Approve(kFirst);
  Activate(kFirst);
  ASSERT_EQ(Tables().size(), 1u);
  EXPECT_TRUE(Tables()[0].spec().box().has_max_y_m());
  v1::CreateCompensationTableRequest request = Request(kTable1, kFirst);
  *request.mutable_compensation_table()->mutable_spec() = spec;
  EXPECT_THAT(CreateCompensationTable(AsAnna(), request),
              HasFaultsAt(Fields{"compensation_table.spec.box.max_y_m"}))
      << "who asks for it now has to say where";
}

// Would catch an activation that fails for its table, or a reason that nobody can find.
TEST_F(TablesTest, WhatCannotBeBuiltIsSaid) {
  v1::CompensationTableSpec ranges;
  for (int i = 0; i < 6; ++i) {
    ranges.mutable_joint_ranges()->add_joints()->set_lower(-1.0);
    ranges.mutable_joint_ranges()->mutable_joints(i)->set_upper(1.0);
  }
  ASSERT_THAT(SetSpec(&ranges), IsOk());
  v1::CompensationTableSpec wrong = ranges;
  wrong.mutable_joint_ranges()->mutable_joints()->RemoveLast();
  EXPECT_THAT(SetSpec(&wrong), HasFaultsAt(Fields{"robot.table_spec.joint_ranges.joints"}));
  // As a spec that was set for another nominal.
  ASSERT_THAT(store().Write([&](store::Transaction& transaction) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, store::GetRobot(transaction, "robots/ur10"));
    *robot.mutable_table_spec() = wrong;
    return store::PutRobot(transaction, robot).status();
  }),
              IsOk());
  Approve(kFirst);
  Activate(kFirst);
  EXPECT_TRUE(Tables().empty()) << "no job";
  const auto active = ActiveTable();
  EXPECT_THAT(active, HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(std::string(active.status().message()),
              ::testing::HasSubstr("compensation_table.spec.joint_ranges.joints"));
}

// Would catch a table that vanishes under an agent that is told to apply it.
TEST_F(TablesTest, DeletedItIsNoLongerTheOneToApply) {
  SetSeed(5);
  Approve(kFirst);
  Activate(kFirst);
  v1::DeleteCompensationTableRequest remove;
  remove.set_name(Tables()[0].name());
  EXPECT_THAT(DeleteCompensationTable(AsAnna(), remove),
              HasCode(absl::StatusCode::kFailedPrecondition));
  Finish(Tables()[0], "one");
  remove.set_etag("\"another\"");
  EXPECT_THAT(DeleteCompensationTable(AsAnna(), remove), HasCode(absl::StatusCode::kAborted));
  remove.clear_etag();
  ASSERT_THAT(DeleteCompensationTable(AsAnna(), remove), IsOk());
  EXPECT_EQ(TheRobot().active_compensation_table(), "");
  v1::UndeleteCompensationTableRequest back;
  back.set_name(remove.name());
  ASSERT_THAT(UndeleteCompensationTable(AsAnna(), back), IsOk());
  EXPECT_EQ(TheRobot().active_compensation_table(), remove.name());
}

// Would catch a table that is brought back without bytes, and a reason that speaks of a digest.
TEST_F(TablesTest, WithoutItsBytesItCannotBeBroughtBack) {
  Approve(kFirst);
  const auto table = Create(kTable1, kFirst);
  Finish(*table, "one");
  v1::DeleteCompensationTableRequest remove;
  remove.set_name(table->name());
  ASSERT_THAT(DeleteCompensationTable(AsAnna(), remove), IsOk());
  ASSERT_THAT(store().Write([](store::Transaction& transaction) -> absl::Status {
    TRUEPOSE_RETURN_IF_ERROR(
        store::sql::Run(transaction.sql(), "UPDATE table_files SET deleted_us = 1"));
    return store::ForgetFile(transaction).status();
  }),
              IsOk());
  v1::UndeleteCompensationTableRequest back;
  back.set_name(table->name());
  EXPECT_THAT(UndeleteCompensationTable(AsAnna(), back),
              HasCode(absl::StatusCode::kFailedPrecondition));
  v1::DownloadRequest download;
  download.set_name(table->name());
  EXPECT_THAT(Download::Begin(call(), download).status(),
              HasCode(absl::StatusCode::kFailedPrecondition));
  const auto anew = Create(kTable2, kFirst);
  ASSERT_THAT(anew, IsOk());
  EXPECT_EQ(anew->state(), v1::TABLE_BUILDING) << "it is not the deleted one";
  Finish(*anew, "one");
  EXPECT_THAT(UndeleteCompensationTable(AsAnna(), back), IsOk()) << "its bytes are there again";
}

// Would catch a look-up by digest that reads every table there is.
TEST_F(TablesTest, ByItsDigestNoOtherIsRead) {
  Approve(kFirst);
  const auto first = Create(kTable1, kFirst, 1), second = Create(kTable2, kFirst, 2);
  Finish(*first, "one");
  Finish(*second, "two");
  ASSERT_THAT(store().Write([&](store::Transaction& transaction) {
    return store::sql::Run(transaction.sql(), "UPDATE resources SET message = x'ff' WHERE id = $1",
                           kTable1);
  }),
              IsOk());
  v1::ListCompensationTablesRequest list;
  list.set_filter(
      absl::StrCat("state = \"TABLE_READY\" AND sha256 = \"", store::Sha256Hex("two"), "\""));
  v1::ListCompensationTablesResponse found;
  ASSERT_THAT(ListStandard(call(), list, found), IsOk());
  ASSERT_EQ(found.compensation_tables_size(), 1);
  EXPECT_EQ(found.compensation_tables(0).name(), second->name());
  list.set_filter("state = \"TABLE_READY\"");
  EXPECT_THAT(ListStandard(call(), list, found), HasCode(absl::StatusCode::kDataLoss))
      << "a list without a digest reads it";
}

// Would catch a dry run that leaves something behind.
TEST_F(TablesTest, ADryRunEstimatesAndStoresNothing) {
  Approve(kFirst);
  v1::CreateCompensationTableRequest request = Request(kTable1, kFirst);
  request.set_validate_only(true);
  EXPECT_THAT(CreateCompensationTable(AsAnna(), request), HasCode(absl::StatusCode::kUnimplemented))
      << "the engine of this test can't";
  EXPECT_TRUE(Tables().empty());
  v1::ActivateCalibrationRequest activate;
  SetSeed(5);
  activate.set_name(kFirst);
  activate.set_validate_only(true);
  ASSERT_THAT(ActivateCalibration(AsAnna(), activate), IsOk());
  EXPECT_TRUE(Tables().empty());
}

// Would catch the download of half a table.
TEST_F(TablesTest, OnlyAReadyOneIsDownloaded) {
  Approve(kFirst);
  const auto table = Create(kTable1, kFirst);
  v1::DownloadRequest request;
  request.set_name(table->name());
  EXPECT_THAT(Download::Begin(call(), request).status(),
              HasCode(absl::StatusCode::kFailedPrecondition));
  Finish(*table, "its bytes");
  auto download = Download::Begin(call(), request);
  ASSERT_THAT(download, IsOk());
  EXPECT_EQ((*(*download)->Next())->chunk(), "its bytes");
  request.set_sha256(store::Sha256Hex("others"));
  EXPECT_THAT(Download::Begin(call(), request).status(), HasCode(absl::StatusCode::kAborted));
}

}  // namespace
}  // namespace truepose::services
