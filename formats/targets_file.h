// Files of compensation targets: CSV with the columns of a session file (docs/formats.md), as
// controller joints `q1_rad`..., as poses `x_mm,y_mm,z_mm,qx,qy,qz,qw` of the tool in the base
// frame B, or as both.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"

namespace truepose::formats {

// Row i of the file (counted from 0, blank lines left out) is targets[i], row = i, in m and rad.
// Columns of other names are not read. Errors as in session_file.h.
absl::StatusOr<std::vector<v1::CompensationTarget>> ReadTargetsFile(const std::string& path,
                                                                    const v1::Nominal& nominal);
absl::StatusOr<std::vector<v1::CompensationTarget>> ParseTargetsFile(std::string_view text,
                                                                     std::string_view file_name,
                                                                     const v1::Nominal& nominal);

// CSV with one line a target: row, q1_rad..., x_mm,y_mm,z_mm,qx,qy,qz,qw, position_correction_mm,
// rotation_correction_deg, residual_position_mm, fault. Joints and quaternions are exact to the
// bit, lengths have 1e-6 mm. A target with a fault has that and its row only; joint or pose columns
// that no target fills are left out. Without faults the text reads back as targets.
std::string WriteCompensatedTargets(const v1::Nominal& nominal,
                                    const v1::CompensateResponse& response);

}  // namespace truepose::formats
