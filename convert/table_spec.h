// What a compensation table is asked to cover: its faults and its digest. Field paths are those of
// v1::CompensationTableSpec, such as `joint_ranges.joints[2].upper` or `box.cone_rad`.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "truepose/v1/compensation_table_spec.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

inline constexpr double kTablePositionTolerance_m = 2e-5;
inline constexpr double kTableRotationTolerance_rad = 8.7e-5;  // 0.005 deg
inline constexpr double kTableSmallestSingularValue = 0.05;
inline constexpr int kTableVerificationPoints = 10'000, kFewestVerificationPoints = 1'000;
inline constexpr int kMostVerificationPoints = 1'000'000;
inline constexpr long long kTableLargestBytes = 64LL << 20;

// Every fault that shows without a robot: edges of the box that are missing, numbers that are not
// finite, ranges upside down, tolerances of 0 and below what a float holds, an approach that is no
// unit vector.
absl::Status ValidateTableSpec(const v1::CompensationTableSpec& spec);

// The same, and what only the robot tells: the number of joints, ranges beyond its limits, a tool
// that it has not.
absl::Status ValidateTableSpec(const v1::Nominal& nominal, const v1::CompensationTableSpec& spec);

// The same spec with the missing edges of its box as 0: one that was stored when 0 and nothing were
// alike. What a caller gives is validated as it is.
v1::CompensationTableSpec StoredTableSpec(v1::CompensationTableSpec spec);

// The stored spec with every default written out, so that equal specs have equal digests.
v1::CompensationTableSpec CompleteTableSpec(const v1::CompensationTableSpec& spec);

// SHA-256 in lower-case hex over text lines: both digests, then the completed spec.
std::string TableInputDigest(const std::string& calibration_digest,
                             const std::string& nominal_digest,
                             const v1::CompensationTableSpec& spec);

}  // namespace truepose::convert
