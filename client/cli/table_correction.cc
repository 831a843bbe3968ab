// Programs corrected by a compensation table.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/cli/program_correction.h"
#include "client/cli/same_robot.h"
#include "client/cli/table_fault.h"
#include "compensation/correct_by_table.h"
#include "compensation/table_file.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

using compensation::Correction;
using compensation::Outcome;
using compensation::Table;
using compensation::TableFile;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

// "q2+q3+q4" of an axis of the domain.
std::string AxisText(const Table& table, int axis) {
  std::string text;
  for (int j = 0; j < table.header.joints; ++j) {
    const double weight = table.axis[static_cast<size_t>(axis)].weight[static_cast<size_t>(j)];
    if (weight == 0.0) continue;
    absl::StrAppend(&text,
                    weight < 0.0   ? "-"
                    : text.empty() ? ""
                                   : "+",
                    std::abs(weight) == 1.0 ? "" : absl::StrCat(std::abs(weight), " "), "q", j + 1);
  }
  return text;
}

// Whether values of the axis are lengths: only joints that slide take part.
bool IsLength(const Table& table, int axis) {
  const auto& weight = table.axis[static_cast<size_t>(axis)].weight;
  for (int j = 0; j < table.header.joints; ++j)
    if (weight[static_cast<size_t>(j)] != 0.0 &&
        !table.arm.nominal.prismatic[static_cast<size_t>(j)])
      return false;
  return true;
}

// A value and its range in mm or deg: "780.00, range -180.00 to 180.00 deg".
std::string InRange(double value, double lower, double upper, bool length) {
  const double scale = length ? 1e3 : kDegPerRad;
  return absl::StrFormat("%.2f, range %.2f to %.2f %s", scale * value, scale * lower, scale * upper,
                         length ? "mm" : "deg");
}

// The axis's coordinate of controller joints (table.h).
double CoordinateOf(const Table& table, int axis, const double* joints) {
  double u = 0;
  for (int i = 0; i < table.header.joints; ++i) {
    double q_chain = table.arm.joint_offset[i];
    for (int j = 0; j < table.header.joints; ++j)
      q_chain += table.arm.joint_scale(i, j) * joints[j];
    u += table.axis[static_cast<size_t>(axis)].weight[static_cast<size_t>(i)] * q_chain;
  }
  return u;
}

std::string OutsideText(const Table& table, int axis, const double* joints) {
  const compensation::TableAxis& range = table.axis[static_cast<size_t>(axis)];
  const double u = CoordinateOf(table, axis, joints);
  // The target may be inside and its correction not.
  const bool inside = u >= range.lower && u <= range.upper;
  return absl::StrCat(inside ? "corrected, " : "", "outside the domain of the table in ",
                      AxisText(table, axis), inside ? ", target " : " ",
                      InRange(u, range.lower, range.upper, IsLength(table, axis)));
}

std::string LimitText(const Table& table, const Correction& correction) {
  const auto joint = static_cast<size_t>(correction.joint);
  const compensation::JointLimits& limits = table.arm.limits[joint];
  return absl::StrCat(
      "corrected, joint ", correction.joint + 1, " is beyond its limits: ",
      InRange(correction.q[joint], limits.lower, limits.upper, table.arm.nominal.prismatic[joint]));
}

std::string FaultText(const Table& table, const Correction& correction, const double* joints) {
  switch (correction.outcome) {
    case Outcome::kOk:
      return "";
    case Outcome::kOutsideDomain:
      return OutsideText(table, correction.joint, joints);
    case Outcome::kNearSingular:
      return absl::StrFormat(
          "near a singularity (smallest singular value %.3g, the table asks for %.3g)",
          correction.smallest_singular_value, table.header.smallest_singular_value);
    case Outcome::kBeyondLimit:
      return LimitText(table, correction);
    case Outcome::kUnreachable:
      return absl::StrFormat("out of reach: %.3g mm and %.3g deg are left",
                             1e3 * correction.position_error_m,
                             kDegPerRad * correction.rotation_error_rad);
    case Outcome::kInvalidArgument:
      break;
  }
  return "no joint values that a robot can have";
}

programs::CorrectedJoints Correct(const Table& table, const std::vector<double>& joints) {
  const Correction correction = CorrectByTable(table, joints.data());
  std::string fault = FaultText(table, correction, joints.data());
  if (!fault.empty()) return {{}, std::move(fault)};
  return {{correction.q.begin(), correction.q.begin() + table.header.joints}, ""};
}

// The digest of convert::NominalDigest as a table has it.
compensation::Digest DigestOf(const v1::Nominal& nominal) {
  const std::string bytes = absl::HexStringToBytes(convert::NominalDigest(nominal));
  compensation::Digest digest{};
  std::copy_n(bytes.begin(), std::min(bytes.size(), digest.size()), digest.begin());
  return digest;
}

}  // namespace

absl::StatusOr<ProgramCorrection> TableCorrection(const std::string& path,
                                                  const TableRobot* robot) {
  compensation::TableExpectation expectation;
  if (robot != nullptr) expectation.nominal_digest = DigestOf(robot->file.nominal);
  const auto file = std::make_shared<TableFile>();
  const compensation::TableReport report = TableFile::Map(path.c_str(), expectation, file.get());
  if (!report.ok()) return TableFaultStatus(report, path, absl::StrCat("--table ", path));
  const Table& table = file->table();
  if (robot != nullptr) {
    TRUEPOSE_RETURN_IF_ERROR(CheckSameRobot(
        {absl::StrCat("--table ", path), "a table", std::string(table.header.robot.view())},
        robot->file, robot->path));
  }
  if (table.arm.measuring) {
    return FaultStatus("--table", absl::StrCat(path, ", of a measuring robot"),
                       "one of a robot that runs programs");
  }
  ProgramCorrection correction;
  const compensation::Digest& digest = table.header.calibration_digest;
  correction.calibration = absl::BytesToHexString(
      absl::string_view(reinterpret_cast<const char*>(digest.data()), digest.size()));
  for (int j = 0; j < table.header.joints; ++j)
    correction.prismatic.push_back(table.arm.nominal.prismatic[static_cast<size_t>(j)]);
  correction.correct = [file](const std::vector<std::vector<double>>& targets)
      -> absl::StatusOr<std::vector<programs::CorrectedJoints>> {
    std::vector<programs::CorrectedJoints> corrected;
    for (const std::vector<double>& joints : targets)
      corrected.push_back(Correct(file->table(), joints));
    return corrected;
  };
  return correction;
}

}  // namespace truepose::cli
