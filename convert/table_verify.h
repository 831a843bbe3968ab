// A table's file held against the calibration that it claims to be of.
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "compensation/lookup.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/table_verification.pb.h"

namespace truepose::convert {

struct TableVerificationOptions {
  int points = 10000;  // to draw, 1000 to 1 million
  uint64_t seed = 2;   // another than the builder's
};

// The truth is the calibration's arm, not the one in the table.
// @returns kInvalidArgument with faults of nominal, calibration, `points`, and of `table` when its
//   digests are those of another robot or calibration; kInternal of VerifyTable.
absl::StatusOr<v1::TableVerification> RunTableVerification(const compensation::Table& table,
                                                           const v1::Nominal& nominal,
                                                           const v1::Calibration& calibration,
                                                           const TableVerificationOptions& options);

}  // namespace truepose::convert
