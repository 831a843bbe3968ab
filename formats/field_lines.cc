#include "formats/field_lines.h"

#include "core/base/fault.h"
#include "formats/strings.h"

namespace truepose::formats {

void FieldLines::Set(std::string_view field, int line) {
  lines_.insert_or_assign(std::string(field), line);
}

int FieldLines::LineOf(std::string_view field) const {
  ConsumePrefix(&field, "nominal.");
  while (!field.empty()) {
    if (const auto it = lines_.find(field); it != lines_.end()) return it->second;
    const size_t last = field.find_last_of(".[");
    field = field.substr(0, last == std::string_view::npos ? 0 : last);
  }
  return 0;
}

std::string FieldLines::Locate(std::string_view field) const {
  const int line = LineOf(field);
  if (line == 0) return StrCat(file_name_, ": ", field);
  return StrCat(file_name_, ":", line, ": ", field);
}

absl::Status LocateFaults(const absl::Status& status, const FieldLines& lines) {
  FaultList located;
  for (const Fault& fault : FaultsOf(status)) {
    located.Add(lines.Locate(fault.field), fault.found, fault.expected);
  }
  return located.empty() ? status : located.ToStatus(status.code());
}

}  // namespace truepose::formats
