// What can be wrong with readings.
#include <optional>

#include "absl/strings/str_cat.h"
#include "convert/rules/reading_rules.h"
#include "convert/run.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

void CheckRowAndReading(const v1::Reading& reading, int joints, std::optional<int> row,
                        const std::string& field, FaultList* faults) {
  if (row.has_value() && reading.row() != *row)
    faults->Add(field + ".row", absl::StrCat(reading.row()),
                absl::StrCat(*row, ", rows without gaps"));
  CheckReading(reading, joints, field, faults);
}

}  // namespace

absl::Status ValidateReadings(const v1::Nominal& nominal, const std::vector<v1::Reading>& readings,
                              int first_row) {
  FaultList faults;
  for (size_t i = 0; i < readings.size(); ++i) {
    CheckRowAndReading(readings[i], nominal.joints_size(), first_row + static_cast<int>(i),
                       absl::StrCat("readings[", i, "]"), &faults);
  }
  return faults.ToStatus();
}

absl::Status ValidateReadings(int joints,
                              const google::protobuf::RepeatedPtrField<v1::Reading>& readings,
                              std::optional<int> first_row) {
  FaultList faults;
  for (int i = 0; i < readings.size(); ++i) {
    const std::optional<int> row = first_row ? std::optional(*first_row + i) : std::nullopt;
    if ((!row || readings[i].row() == *row) && IsSound(readings[i], joints)) continue;
    CheckRowAndReading(readings[i], joints, row, absl::StrCat("readings[", i, "]"), &faults);
  }
  return faults.ToStatus();
}

}  // namespace truepose::convert
