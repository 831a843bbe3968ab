// Calibrations: immutable results, numbered per robot from 1.
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "server/store/list.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::store {

// Stores the result of `job` under the robot's next number and returns it with name, job,
// created_by, create_time and options set.
//
// Equal content is stored once: when the robot has a calibration that is the same in all that a run
// finds and was given, that one is returned, as it stands, and nothing is stored. The same is
// everything but name, job, created_by, create_time, provenance and the way of release: sessions,
// nominal revision, options, parameters, covariance, frames, report and residuals, each bit. Equal
// parameters (the digest) alone are not enough: with another split the verdict differs, with
// calibrate = external all parameters stay and the frames differ, and with another session its
// operator, who may not approve, does. A calibration that was stored before its content could be
// looked up (migration queue) is never found.
// @returns kAlreadyExists when the job has a calibration already.
absl::StatusOr<v1::Calibration> InsertCalibration(Transaction& transaction,
                                                  const v1::CalibrationJob& job,
                                                  const v1::Calibration& calibration);
absl::StatusOr<v1::Calibration> GetCalibration(Snapshot& snapshot, std::string_view name);
// Newest first by number, without residuals and covariance. `robot_name` is required. @returns
// kNotFound for an unknown robot.
absl::StatusOr<Page<v1::Calibration>> ListCalibrations(
    Snapshot& snapshot, std::string_view robot_name, const PageRequest& request,
    const ListFilter<v1::Calibration>& filter = {});

}  // namespace truepose::store
