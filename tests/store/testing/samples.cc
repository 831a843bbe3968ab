#include "tests/store/testing/samples.h"

#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/calibrations.h"
#include "server/store/compensation_tables.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::store {
namespace {

template <typename Closure>
void MustWrite(Store& store, Closure closure) {
  const auto result = store.Write(closure);
  ASSERT_TRUE(result.ok()) << result.status();
}

}  // namespace

std::string Uuid(int number) { return absl::StrFormat("00000000-0000-4000-8000-%012x", number); }

v1::Nominal SampleNominal(const std::string& serial) {
  v1::Nominal nominal;
  nominal.set_serial(serial);
  nominal.set_kind(v1::INDUSTRIAL);
  nominal.add_joints()->set_name("q1");
  return nominal;
}

v1::Reading SampleReading(int row) {
  v1::Reading reading;
  reading.set_row(row);
  reading.add_joints_measured(0.25 * row);
  reading.mutable_position_m()->set_x(1.0 + row);
  return reading;
}

google::protobuf::RepeatedPtrField<v1::Reading> SampleReadings(int first, int count) {
  google::protobuf::RepeatedPtrField<v1::Reading> readings;
  for (int row = first; row < first + count; ++row) *readings.Add() = SampleReading(row);
  return readings;
}

v1::Session SampleSession(const std::string& robot_id) {
  v1::Session session;
  session.set_robot(RobotName(robot_id));
  session.set_display_name("monday");
  session.set_source("monday.csv");
  session.add_extra_columns("operator");
  return session;
}

v1::CalibrationJob SampleJob(const std::string& robot_id, const std::vector<int>& sessions) {
  v1::CalibrationJob job;
  job.set_robot(RobotName(robot_id));
  for (const int session : sessions) job.add_sessions(SessionName(Uuid(session)));
  job.mutable_options()->set_split("even-odd");
  job.set_nominal_revision(NominalName(robot_id, 1));
  job.set_input_digest("input digest");
  return job;
}

v1::Calibration SampleCalibration() {
  v1::Calibration calibration;
  calibration.set_digest("result digest");
  calibration.add_covariance(0.5);
  calibration.add_residuals()->set_row(3);
  calibration.mutable_report()->set_model("modified_incremental");
  return calibration;
}

void AddRobot(Store& store, const std::string& robot_id) {
  MustWrite(store, [&](Transaction& transaction) {
    return CreateRobot(transaction, robot_id, SampleNominal(robot_id), "digest of " + robot_id);
  });
}

void AddSession(Store& store, int number, const std::string& robot_id, int rows) {
  MustWrite(store, [&](Transaction& transaction) {
    return CreateSession(transaction, Uuid(number), SampleSession(robot_id));
  });
  MustWrite(store, [&](Transaction& transaction) {
    return AppendReadings(transaction, SessionName(Uuid(number)),
                          ReadingBatch(SampleReadings(0, rows)));
  });
}

void AddSealedSession(Store& store, int number, const std::string& robot_id, int rows) {
  AddSession(store, number, robot_id, rows);
  MustWrite(store, [&](Transaction& transaction) {
    return SealSession(transaction, SessionName(Uuid(number)), rows, "readings digest");
  });
}

void AddRobotWithSession(Store& store) {
  AddRobot(store, "ur10");
  AddSealedSession(store, 1, "ur10", 4);
}

std::string AddJob(Store& store, int number, const std::string& robot_id,
                   const std::vector<int>& sessions) {
  v1::CalibrationJob job = SampleJob(robot_id, sessions);
  job.set_input_digest(absl::StrCat("input digest ", number));
  MustWrite(store,
            [&](Transaction& transaction) { return CreateJob(transaction, Uuid(number), job); });
  return JobName(Uuid(number));
}

std::string AddCalibration(Store& store, int number, const std::string& robot_id, int session) {
  const std::string name = AddJob(store, number, robot_id, {session});
  std::string calibration;
  MustWrite(store, [&](Transaction& transaction) -> absl::StatusOr<v1::CalibrationJob> {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, GetJob(transaction, name));
    v1::Calibration result = SampleCalibration();
    result.set_nominal_revision(job.nominal_revision());
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration stored,
                              InsertCalibration(transaction, job, result));
    calibration = stored.name();
    job.set_calibration(calibration);
    job.set_state(v1::SUCCEEDED);
    TRUEPOSE_RETURN_IF_ERROR(UpdateJob(transaction, job, 0));
    return job;
  });
  return calibration;
}

std::string AddTableJob(Store& store, int number, const std::string& calibration,
                        const std::string& robot_id) {
  const std::string name = CompensationTableName(robot_id, Uuid(number));
  v1::CompensationTable table;
  table.set_name(name);
  table.set_calibration(calibration);
  table.mutable_spec()->set_seed(static_cast<uint64_t>(number));
  table.set_state(v1::TABLE_BUILDING);
  table.set_job(JobName(Uuid(number)));
  v1::CalibrationJob job = SampleJob(robot_id, {});
  job.clear_options();
  job.set_input_digest(absl::StrCat("input digest ", number));
  job.set_compensation_table(name);
  MustWrite(store, [&](Transaction& transaction) -> absl::StatusOr<v1::CalibrationJob> {
    TRUEPOSE_RETURN_IF_ERROR(PutTable(transaction, table));
    return CreateJob(transaction, Uuid(number), job);
  });
  return name;
}

std::vector<std::string> FaultFields(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

}  // namespace truepose::store
