// What a row of a session file may have beside one pose: points p1 to p9, a distance, a feature.
#pragma once

#include <vector>

#include "formats/column.h"
#include "formats/row_reader.h"
#include "truepose/v1/session.pb.h"

namespace truepose::formats {

// x, y, z. @param values at least three.
void SetVector(const std::vector<double>& values, v1::Vector3* vector);

class FurtherReader {
 public:
  // Both arguments have to outlive the reader.
  FurtherReader(const RowReader& reader, const Columns& columns)
      : reader_(reader), columns_(columns) {}

  // Sets points, distance, distance_sd, anchor, beam and feature. Faults go to the reader's list.
  void Read(const CsvRow& row, v1::Reading& reading);

 private:
  using Outcome = RowReader::Outcome;

  void ReadPoint(const CsvRow& row, int point, v1::Reading& reading);
  void ReadDistance(const CsvRow& row, v1::Reading& reading);
  void CheckDistance(const CsvRow& row, const v1::Reading& reading) const;
  void CheckDeviations(const CsvRow& row, Quantity quantity) const;

  const RowReader& reader_;
  const Columns& columns_;
  std::vector<double> values_;
};

// A fault for each column of a deviation whose quantity the table does not have.
void CheckDeviationColumns(const Columns& columns, const std::string& place, FaultList& faults);

}  // namespace truepose::formats
