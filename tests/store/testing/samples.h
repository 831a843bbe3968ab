// Small resources for tests, and the shortest way to store them.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "google/protobuf/repeated_field.h"
#include "server/store/store.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::store {

std::string Uuid(int number);

v1::Nominal SampleNominal(const std::string& serial);
// Differs from row to row.
v1::Reading SampleReading(int row);
google::protobuf::RepeatedPtrField<v1::Reading> SampleReadings(int first, int count);
// A session of robots/`robot_id`.
v1::Session SampleSession(const std::string& robot_id);
// A job over sessions of robots/`robot_id`, by their numbers.
v1::CalibrationJob SampleJob(const std::string& robot_id, const std::vector<int>& sessions);
// A result with something in each part.
v1::Calibration SampleCalibration();

// Each stores what it says and fails the test when it can't.
void AddRobot(Store& store, const std::string& robot_id);
void AddSession(Store& store, int number, const std::string& robot_id, int rows);
void AddSealedSession(Store& store, int number, const std::string& robot_id, int rows);
// A robot `ur10` with the sealed session 1.
void AddRobotWithSession(Store& store);
// With an input digest of its own. @returns its name.
std::string AddJob(Store& store, int number, const std::string& robot_id = "ur10",
                   const std::vector<int>& sessions = {1});

// The result of a job of its own over session `session`, which has SUCCEEDED. @returns its name.
std::string AddCalibration(Store& store, int job, const std::string& robot_id = "ur10",
                           int session = 1);
// A table that is BUILDING and the PENDING job that builds it, both with this number. @returns the
// table's name.
std::string AddTableJob(Store& store, int number, const std::string& calibration,
                        const std::string& robot_id = "ur10");

// The fields of the faults that a status carries.
std::vector<std::string> FaultFields(const absl::Status& status);

}  // namespace truepose::store
