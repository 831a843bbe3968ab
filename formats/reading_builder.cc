#include "formats/reading_builder.h"

#include <string>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/time/time.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

// Euler angles in files have about nine digits; a wrong convention is off by far more.
constexpr double kMostDisagreementRad = 1e-4;

void SetQuaternion(const QuaternionArray& values, v1::Quaternion* quaternion) {
  quaternion->set_x(values[0]);
  quaternion->set_y(values[1]);
  quaternion->set_z(values[2]);
  quaternion->set_w(values[3]);
}

bool IsIsoTime(std::string_view text) {
  absl::Time time;
  // ParseTime also takes words such as infinite-future.
  return absl::ascii_isdigit(text[0]) &&
         absl::ParseTime(absl::RFC3339_full, std::string(text), &time, nullptr);
}

}  // namespace

ReadingBuilder::ReadingBuilder(const RowReader& reader, const Columns& columns,
                               std::optional<EulerConvention> euler)
    : reader_(reader), columns_(columns), euler_(std::move(euler)), further_(reader, columns) {}

v1::Reading ReadingBuilder::Build(const CsvRow& row, int number) {
  v1::Reading reading;
  reading.set_row(number);
  SetJoints(row, reading);
  SetPosition(row, reading);
  SetPositionSd(row, reading);
  SetOrientation(row, reading);
  SetAxis(row, reading);
  CheckCoordinates(row, reading);
  further_.Read(row, reading);
  SetSurroundings(row, reading);
  SetTime(row, reading);
  for (const Column& column : columns_.extra()) {
    reading.add_extra_values(std::string(row.cells[column.cell]));
  }
  return reading;
}

void ReadingBuilder::SetJoints(const CsvRow& row, v1::Reading& reading) {
  const Outcome measured = reader_.ReadNumbers(row, Quantity::kMeasuredJoint, values_);
  if (measured == Outcome::kThere)
    reading.mutable_joints_measured()->Assign(values_.begin(), values_.end());
  const Outcome commanded = reader_.ReadNumbers(row, Quantity::kCommandedJoint, values_);
  if (commanded == Outcome::kThere)
    reading.mutable_joints_commanded()->Assign(values_.begin(), values_.end());
  if (measured != Outcome::kAbsent || commanded != Outcome::kAbsent) return;
  for (const Quantity quantity : {Quantity::kMeasuredJoint, Quantity::kCommandedJoint}) {
    const ColumnGroup* group = columns_.Find(quantity);
    // Without any joint column the header has the fault.
    if (group == nullptr) continue;
    return reader_.AddFault(row, group->columns[0].name, "no joint in this row",
                            "measured or commanded joints");
  }
}

void ReadingBuilder::SetPosition(const CsvRow& row, v1::Reading& reading) {
  if (reader_.ReadSome(row, Quantity::kPosition, some_) != Outcome::kThere) return;
  std::string measured;
  values_.assign(3, 0);
  for (size_t i = 0; i < some_.size(); ++i) {
    if (!some_[i]) continue;
    values_[i] = *some_[i];
    measured += "xyz"[i];
  }
  SetVector(values_, reading.mutable_position_m());
  if (measured.size() < 3) reading.set_coordinates(measured);
}

// A deviation of a coordinate that was not measured is dropped.
void ReadingBuilder::SetPositionSd(const CsvRow& row, v1::Reading& reading) {
  if (reader_.ReadSome(row, Quantity::kPositionSd, some_) != Outcome::kThere) return;
  const ColumnGroup& group = *columns_.Find(Quantity::kPositionSd);
  const std::string& measured = reading.coordinates();
  values_.assign(3, 0);
  for (size_t i = 0; i < some_.size(); ++i) {
    const Column& column = group.columns[i];
    const bool is_needed = measured.empty() || measured.find("xyz"[i]) != std::string::npos;
    if (!is_needed || column.cell == Column::kMissing) continue;
    if (!some_[i]) {
      reader_.AddEmptyCell(row, group, column);
      continue;
    }
    values_[i] = *some_[i];
    if (values_[i] < 0)
      reader_.AddFault(row, column.name, Quoted(row.cells[column.cell]),
                       "a standard deviation, at least 0");
  }
  SetVector(values_, reading.mutable_position_sd_m());
}

// Of a pose with a coordinate missing nobody knows whether that was meant.
void ReadingBuilder::CheckCoordinates(const CsvRow& row, const v1::Reading& reading) {
  if (reading.coordinates().empty() || (!reading.has_orientation() && !reading.has_axis())) return;
  const ColumnGroup& group = *columns_.Find(Quantity::kPosition);
  for (size_t i = 0; i < group.columns.size(); ++i) {
    if (reading.coordinates().find("xyz"[i]) != std::string::npos) continue;
    reader_.AddEmptyCell(row, group, group.columns[i]);
  }
}

void ReadingBuilder::SetOrientation(const CsvRow& row, v1::Reading& reading) {
  const std::optional<QuaternionArray> quaternion = ReadQuaternion(row);
  const std::optional<QuaternionArray> euler = ReadEuler(row);
  if (quaternion && euler) CheckAgreement(row, *quaternion, *euler);
  if (quaternion || euler) {
    SetQuaternion(quaternion ? *quaternion : *euler, reading.mutable_orientation());
  }
}

std::optional<QuaternionArray> ReadingBuilder::ReadQuaternion(const CsvRow& row) {
  if (reader_.ReadNumbers(row, Quantity::kQuaternion, values_) != Outcome::kThere)
    return std::nullopt;
  if (!Normalise(row, "qx,qy,qz,qw")) return std::nullopt;
  return QuaternionArray{values_[0], values_[1], values_[2], values_[3]};
}

std::optional<QuaternionArray> ReadingBuilder::ReadEuler(const CsvRow& row) {
  if (!euler_ || reader_.ReadNumbers(row, Quantity::kEuler, values_) != Outcome::kThere)
    return std::nullopt;
  return FromEuler(*euler_, {values_[0], values_[1], values_[2]});
}

void ReadingBuilder::CheckAgreement(const CsvRow& row, const QuaternionArray& quaternion,
                                    const QuaternionArray& euler) {
  const double angle = AngleBetween(quaternion, euler);
  if (angle <= kMostDisagreementRad) return;
  reader_.AddFault(
      row, columns_.Find(Quantity::kEuler)->columns[0].name,
      StrCat("an orientation ", angle, " rad away from qx,qy,qz,qw"),
      StrCat("at most ", kMostDisagreementRad, " rad in the convention that is named"));
}

void ReadingBuilder::SetAxis(const CsvRow& row, v1::Reading& reading) {
  if (reader_.ReadNumbers(row, Quantity::kAxis, values_) != Outcome::kThere) return;
  if (Normalise(row, "axis_x,axis_y,axis_z")) SetVector(values_, reading.mutable_axis());
}

bool ReadingBuilder::Normalise(const CsvRow& row, std::string_view columns) {
  if (NormaliseRounded(values_)) return true;
  reader_.AddFault(row, columns, StrCat("a length of ", FormatNumber(Length(values_))),
                   "1 within 0.001");
  return false;
}

void ReadingBuilder::SetSurroundings(const CsvRow& row, v1::Reading& reading) {
  if (reader_.ReadNumbers(row, Quantity::kTemperature, values_) == Outcome::kThere) {
    reading.set_temperature_c(values_[0]);
  }
  if (reader_.ReadNumbers(row, Quantity::kTorque, values_) == Outcome::kThere) {
    reading.mutable_joint_torques_nm()->Assign(values_.begin(), values_.end());
  }
  reading.set_placement(std::string(reader_.ReadText(row, Quantity::kPlacement)));
  reading.set_target(std::string(reader_.ReadText(row, Quantity::kTarget)));
  reading.set_group(std::string(reader_.ReadText(row, Quantity::kGroup)));
}

void ReadingBuilder::SetTime(const CsvRow& row, v1::Reading& reading) {
  const std::string_view time = reader_.ReadText(row, Quantity::kTime);
  if (time.empty()) return;
  if (!IsIsoTime(time)) {
    return reader_.AddFault(row, "time", Quoted(time),
                            "ISO 8601 with offset, such as 2025-03-14T09:26:53+01:00");
  }
  reading.set_time(std::string(time));
}

}  // namespace truepose::formats
