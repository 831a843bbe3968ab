// Calibrations: immutable results, numbered per robot from 1.
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::store {

// Stores the result of `job` under the robot's next number and returns it with name, job,
// create_time and options set.
// @returns kAlreadyExists when the job has a calibration already.
absl::StatusOr<v1::Calibration> InsertCalibration(Transaction& transaction,
                                                  const v1::CalibrationJob& job,
                                                  const v1::Calibration& calibration);
absl::StatusOr<v1::Calibration> GetCalibration(Snapshot& snapshot, std::string_view name);
// Newest first by number, without residuals and covariance. `robot_name` is required. @returns
// kNotFound for an unknown robot.
absl::StatusOr<Page<v1::Calibration>> ListCalibrations(Snapshot& snapshot,
                                                       std::string_view robot_name,
                                                       const PageRequest& request);

}  // namespace truepose::store
