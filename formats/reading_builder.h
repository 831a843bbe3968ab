// One row of a session file -> one reading.
#pragma once

#include <optional>
#include <vector>

#include "formats/column.h"
#include "formats/further_reader.h"
#include "formats/rotation.h"
#include "formats/row_reader.h"
#include "truepose/v1/session.pb.h"

namespace truepose::formats {

class ReadingBuilder {
 public:
  // Both arguments have to outlive the builder.
  // @param euler convention of rx, ry, rz; only used when the file has these columns.
  ReadingBuilder(const RowReader& reader, const Columns& columns,
                 std::optional<EulerConvention> euler);

  // The reading with that row number. Faults go to the reader's list; a reading with faults is of
  // no use.
  v1::Reading Build(const CsvRow& row, int number);

 private:
  using Outcome = RowReader::Outcome;

  void SetJoints(const CsvRow& row, v1::Reading& reading);
  void SetPosition(const CsvRow& row, v1::Reading& reading);
  void SetPositionSd(const CsvRow& row, v1::Reading& reading);
  void CheckCoordinates(const CsvRow& row, const v1::Reading& reading);
  void SetOrientation(const CsvRow& row, v1::Reading& reading);
  void SetAxis(const CsvRow& row, v1::Reading& reading);
  void SetSurroundings(const CsvRow& row, v1::Reading& reading);
  void SetTime(const CsvRow& row, v1::Reading& reading);

  std::optional<QuaternionArray> ReadQuaternion(const CsvRow& row);
  std::optional<QuaternionArray> ReadEuler(const CsvRow& row);
  void CheckAgreement(const CsvRow& row, const QuaternionArray& quaternion,
                      const QuaternionArray& euler);
  bool Normalise(const CsvRow& row, std::string_view columns);

  const RowReader& reader_;
  const Columns& columns_;
  std::optional<EulerConvention> euler_;
  FurtherReader further_;
  std::vector<double> values_;  // of the group that is being read
  std::vector<std::optional<double>> some_;
};

}  // namespace truepose::formats
