#include "formats/further_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

const Column& FirstOf(const ColumnGroup& group) {
  return *std::find_if(group.columns.begin(), group.columns.end(),
                       [](const Column& column) { return column.cell != Column::kMissing; });
}

}  // namespace

void SetVector(const std::vector<double>& values, v1::Vector3* vector) {
  vector->set_x(values[0]);
  vector->set_y(values[1]);
  vector->set_z(values[2]);
}

void FurtherReader::Read(const CsvRow& row, v1::Reading& reading) {
  for (int point = 1; point <= kMostPoints; ++point) ReadPoint(row, point, reading);
  ReadDistance(row, reading);
  reading.set_feature(std::string(reader_.ReadText(row, Quantity::kFeature)));
}

void FurtherReader::ReadPoint(const CsvRow& row, int point, v1::Reading& reading) {
  const Outcome position = reader_.ReadNumbers(row, PositionOfPoint(point), values_);
  if (position == Outcome::kThere) {
    v1::MeasuredPoint* measured = reading.add_points();
    measured->set_target(StrCat("p", point));
    SetVector(values_, measured->mutable_position_m());
  }
  if (reader_.ReadNumbers(row, DeviationOfPoint(point), values_) != Outcome::kThere) return;
  CheckDeviations(row, DeviationOfPoint(point));
  if (position != Outcome::kThere) return;
  SetVector(values_, reading.mutable_points()->rbegin()->mutable_position_sd_m());
}

void FurtherReader::ReadDistance(const CsvRow& row, v1::Reading& reading) {
  reading.set_anchor(std::string(reader_.ReadText(row, Quantity::kAnchor)));
  reading.set_beam(std::string(reader_.ReadText(row, Quantity::kBeam)));
  if (reader_.ReadNumbers(row, Quantity::kDistance, values_) == Outcome::kThere) {
    reading.set_distance_m(values_[0]);
    CheckDistance(row, reading);
  }
  if (reader_.ReadNumbers(row, Quantity::kDistanceSd, values_) != Outcome::kThere) return;
  CheckDeviations(row, Quantity::kDistanceSd);
  if (reading.has_distance_m()) reading.set_distance_sd_m(values_[0]);
}

// An interferometer counts from anywhere, so only a distance without a beam has a sign that's
// wrong.
void FurtherReader::CheckDistance(const CsvRow& row, const v1::Reading& reading) const {
  const Column& column = columns_.Find(Quantity::kDistance)->columns[0];
  if (reading.distance_m() < 0 && reading.beam().empty()) {
    reader_.AddFault(row, column.name, Quoted(row.cells[column.cell]),
                     "a distance, at least 0, or a name in the column beam");
  }
  if (!reading.anchor().empty()) return;
  reader_.AddFault(row, "anchor", "no name",
                   StrCat("the point from which ", column.name, " was measured"));
}

void FurtherReader::CheckDeviations(const CsvRow& row, Quantity quantity) const {
  const ColumnGroup& group = *columns_.Find(quantity);
  for (size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] >= 0) continue;
    const Column& column = group.columns[i];
    reader_.AddFault(row, column.name, Quoted(row.cells[column.cell]),
                     "a standard deviation, at least 0");
  }
}

void CheckDeviationColumns(const Columns& columns, const std::string& place, FaultList& faults) {
  const auto check = [&](Quantity deviation, Quantity of, const std::string& expected) {
    const ColumnGroup* group = columns.Find(deviation);
    if (group == nullptr || columns.Find(of) != nullptr) return;
    faults.Add(StrCat(place, ": ", FirstOf(*group).name), "a deviation of nothing",
               StrCat(expected, " beside it"));
  };
  check(Quantity::kDistanceSd, Quantity::kDistance, "distance_mm or distance_m");
  for (int point = 1; point <= kMostPoints; ++point) {
    check(DeviationOfPoint(point), PositionOfPoint(point),
          StrCat("p", point, "_x_mm or p", point, "_x_m"));
  }
}

}  // namespace truepose::formats
