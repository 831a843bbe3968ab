// The columns of a session by name: those of its messages, and the extra ones.
#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/readings.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

using Sessions = std::vector<const v1::SessionInput*>;

const std::string* BuiltInColumn(const v1::Reading& reading, const std::string& column) {
  if (column == "placement") return &reading.placement();
  if (column == "target") return &reading.target();
  if (column == "group") return &reading.group();
  if (column == "time") return &reading.time();
  if (column == "feature") return &reading.feature();
  if (column == "anchor") return &reading.anchor();
  if (column == "beam") return &reading.beam();
  return nullptr;
}

absl::Status UnknownColumn(const v1::Session& session, const std::string& column,
                           const std::string& field) {
  std::vector<std::string> names = {"placement", "target", "group", "time",
                                    "feature",   "anchor", "beam"};
  names.insert(names.end(), session.extra_columns().begin(), session.extra_columns().end());
  return FaultStatus(field, absl::StrCat("column '", column, "'"),
                     absl::StrCat("one of ", absl::StrJoin(names, ", ")));
}

}  // namespace

absl::StatusOr<std::vector<std::string>> ColumnValues(const Sessions& sessions,
                                                      const std::string& column,
                                                      const std::string& field) {
  std::vector<std::string> values;
  for (const v1::SessionInput* session : sessions) {
    const auto& extra = session->session().extra_columns();
    const auto it = std::find(extra.begin(), extra.end(), column);
    const int index = static_cast<int>(it - extra.begin());
    for (const v1::Reading& reading : session->readings()) {
      if (const std::string* value = BuiltInColumn(reading, column)) {
        values.push_back(*value);
      } else if (it != extra.end() && index < reading.extra_values_size()) {
        values.push_back(reading.extra_values(index));
      } else {
        return UnknownColumn(session->session(), column, field);
      }
    }
  }
  return values;
}

}  // namespace truepose::convert
