#include "formats/targets_file.h"

#include <algorithm>
#include <utility>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/column.h"
#include "formats/csv.h"
#include "formats/number.h"
#include "formats/rotation.h"
#include "formats/row_reader.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

using Outcome = RowReader::Outcome;

constexpr size_t kMostBytes = size_t{1} << 30;

// False when the header makes no target, whatever the rows hold.
bool CheckColumns(const Columns& columns, const std::string& place, FaultList& faults) {
  const ColumnGroup* commanded = columns.Find(Quantity::kCommandedJoint);
  if (commanded != nullptr) {
    const auto named = std::find_if(commanded->columns.begin(), commanded->columns.end(),
                                    [](const Column& column) { return !column.name.empty(); });
    faults.Add(StrCat(place, ": ", named->name), "a commanded joint",
               "the joints of a target without _cmd, such as q1_rad");
    return false;
  }
  const bool position = columns.Find(Quantity::kPosition) != nullptr;
  const bool orientation = columns.Find(Quantity::kQuaternion) != nullptr;
  if (position != orientation) {
    faults.Add(place, position ? "x,y,z without qx,qy,qz,qw" : "qx,qy,qz,qw without x,y,z",
               "position and orientation of a pose");
  } else if (!position && columns.Find(Quantity::kMeasuredJoint) == nullptr) {
    faults.Add(place, "no column of a target", "q1_rad..., or x_mm,y_mm,z_mm,qx,qy,qz,qw, or both");
  } else {
    return true;
  }
  return false;
}

void SetRotation(const std::vector<double>& q, v1::Pose* pose) {
  // One sign of the two, as the message asks for.
  const double sign = q[3] < 0 ? -1 : 1;
  pose->set_qx(sign * q[0]);
  pose->set_qy(sign * q[1]);
  pose->set_qz(sign * q[2]);
  pose->set_qw(sign * q[3]);
}

// kThere only with position and orientation.
Outcome ReadPose(const RowReader& reader, const CsvRow& row, v1::Pose& pose) {
  std::vector<double> p, q;
  const Outcome position = reader.ReadNumbers(row, Quantity::kPosition, p);
  const Outcome orientation = reader.ReadNumbers(row, Quantity::kQuaternion, q);
  if (position == Outcome::kFaulty || orientation == Outcome::kFaulty) return Outcome::kFaulty;
  if (position != orientation) {
    const bool has_position = position == Outcome::kThere;
    reader.AddFault(row, has_position ? "qx,qy,qz,qw" : "x,y,z", "empty cells",
                    "position and orientation of a pose");
    return Outcome::kFaulty;
  }
  if (position == Outcome::kAbsent) return Outcome::kAbsent;
  if (!NormaliseRounded(q)) {
    reader.AddFault(row, "qx,qy,qz,qw", StrCat("a length of ", FormatNumber(Length(q))),
                    "1 within 0.001");
    return Outcome::kFaulty;
  }
  pose.set_x_m(p[0]);
  pose.set_y_m(p[1]);
  pose.set_z_m(p[2]);
  SetRotation(q, &pose);
  return Outcome::kThere;
}

v1::CompensationTarget ReadTarget(const RowReader& reader, const CsvRow& row, int number) {
  v1::CompensationTarget target;
  target.set_row(number);
  std::vector<double> joints;
  const Outcome has_joints = reader.ReadNumbers(row, Quantity::kMeasuredJoint, joints);
  if (has_joints == Outcome::kThere) target.mutable_joints()->Assign(joints.begin(), joints.end());
  v1::Pose pose;
  const Outcome has_pose = ReadPose(reader, row, pose);
  if (has_pose == Outcome::kThere) *target.mutable_pose() = pose;
  if (has_joints == Outcome::kAbsent && has_pose == Outcome::kAbsent) {
    reader.AddFault(row, "target", "empty cells", "joints or a pose");
  }
  return target;
}

// Of a table whose header is at fault: what else is wrong with it.
void CheckNumbers(const RowReader& reader, const CsvRow& row) {
  std::vector<double> values;
  for (const Quantity quantity :
       {Quantity::kMeasuredJoint, Quantity::kPosition, Quantity::kQuaternion}) {
    reader.ReadNumbers(row, quantity, values);
  }
}

}  // namespace

absl::StatusOr<std::vector<v1::CompensationTarget>> ReadTargetsFile(const std::string& path,
                                                                    const v1::Nominal& nominal) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(path, kMostBytes));
  return ParseTargetsFile(text, path, nominal);
}

absl::StatusOr<std::vector<v1::CompensationTarget>> ParseTargetsFile(std::string_view text,
                                                                     std::string_view file_name,
                                                                     const v1::Nominal& nominal) {
  FaultList faults;
  const CsvTable table = ParseCsv(text, file_name, faults);
  if (table.header.cells.empty()) return faults.ToStatus();
  const Columns columns(table.header, KnownColumns(nominal, false), file_name, faults);
  const bool usable = CheckColumns(columns, StrCat(file_name, ":", table.header.line), faults);
  const RowReader reader(table, columns, file_name, faults);
  std::vector<v1::CompensationTarget> targets;
  for (const CsvRow& row : table.rows) {
    if (IsEnough(faults)) break;
    if (usable) {
      targets.push_back(ReadTarget(reader, row, static_cast<int>(targets.size())));
    } else {
      CheckNumbers(reader, row);
    }
  }
  if (targets.empty() && faults.empty()) {
    faults.Add(std::string(file_name), "no rows under the header", "at least one target");
  }
  if (!faults.empty()) return faults.ToStatus();
  return targets;
}

}  // namespace truepose::formats
