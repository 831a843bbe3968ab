#include "formats/session_file.h"

#include <functional>
#include <optional>
#include <unordered_set>
#include <utility>

#include "absl/strings/str_join.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/column.h"
#include "formats/csv.h"
#include "formats/further_reader.h"
#include "formats/reading_builder.h"
#include "formats/row_reader.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

// A million readings are about 300 MB of text.
constexpr size_t kMostBytes = size_t{4} << 30;
// Of rows that stand twice a person looks at the first.
constexpr size_t kMostRepeatsShown = 20;

// Finds rows that are equal in every column to an earlier one. The rows have to outlive it.
class Repeats {
 public:
  bool IsRepeat(const CsvRow& row) {
    const auto [first, is_new] = rows_.insert(&row);
    if (is_new) return false;
    if (count_++ < kMostRepeatsShown) {
      shown_.push_back(StrCat("line ", row.line, " as line ", (*first)->line));
    }
    return true;
  }

  std::optional<std::string> Warning(std::string_view file_name) const {
    if (count_ == 0) return std::nullopt;
    const std::string rest =
        count_ > shown_.size() ? StrCat(" and ", count_ - shown_.size(), " more") : "";
    return StrCat(file_name,
                  ": rows equal in every column are kept once: ", absl::StrJoin(shown_, ", "),
                  rest);
  }

 private:
  struct Hash {
    size_t operator()(const CsvRow* row) const {
      size_t hash = 0;
      for (const std::string_view cell : row->cells) {
        hash = hash * 31 + std::hash<std::string_view>()(cell);
      }
      return hash;
    }
  };
  struct Equal {
    bool operator()(const CsvRow* a, const CsvRow* b) const { return a->cells == b->cells; }
  };

  std::unordered_set<const CsvRow*, Hash, Equal> rows_;
  std::vector<std::string> shown_;
  size_t count_ = 0;
};

// Finds rows with fewer coordinates than the table has columns: an empty cell may be a slip.
class FewerCoordinates {
 public:
  explicit FewerCoordinates(const Columns& columns) {
    const ColumnGroup* group = columns.Find(Quantity::kPosition);
    if (group == nullptr) return;
    for (const Column& column : group->columns) columns_ += column.cell != Column::kMissing;
  }

  void Note(const CsvRow& row, const v1::Reading& reading) {
    if (reading.coordinates().empty() || reading.coordinates().size() == columns_) return;
    if (count_++ < kMostRepeatsShown) shown_.push_back(row.line);
  }

  std::optional<std::string> Warning(std::string_view file_name) const {
    if (count_ == 0) return std::nullopt;
    return StrCat(file_name, ": only some of x, y, z are there and taken as they are: line ",
                  absl::StrJoin(shown_, ", line "),
                  count_ > shown_.size() ? StrCat(" and ", count_ - shown_.size(), " more") : "");
  }

 private:
  size_t columns_ = 0, count_ = 0;
  std::vector<int> shown_;
};

// "q1_rad to q6_rad"
std::string JointNames(const v1::Nominal& nominal, std::string_view infix) {
  const int n = nominal.joints_size();
  if (n == 0) return "those of a robot with joints";
  const auto name = [&](int i) {
    const bool prismatic = nominal.joints(i - 1).type() == v1::PRISMATIC;
    return StrCat("q", i, infix, prismatic ? "_mm" : "_rad");
  };
  return n == 1 ? name(1) : StrCat(name(1), " to ", name(n));
}

void CheckHasJoints(const Columns& columns, const v1::Nominal& nominal, std::string place,
                    FaultList& faults) {
  if (columns.Find(Quantity::kMeasuredJoint) || columns.Find(Quantity::kCommandedJoint)) return;
  faults.Add(std::move(place), "no column of a joint",
             StrCat(JointNames(nominal, ""), ", or ", JointNames(nominal, "_cmd")));
}

std::optional<EulerConvention> Convention(const SessionFileOptions& options, FaultList& faults) {
  if (options.euler.empty()) return std::nullopt;
  const auto convention = ParseEulerConvention(options.euler);
  faults.AddAll(convention.status());
  return convention.ok() ? std::optional(*convention) : std::nullopt;
}

std::vector<v1::Reading> ReadRows(const CsvTable& table, ReadingBuilder& builder, Repeats& repeats,
                                  FewerCoordinates& fewer, const FaultList& faults) {
  std::vector<v1::Reading> readings;
  readings.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    if (IsEnough(faults)) break;
    if (repeats.IsRepeat(row)) continue;
    readings.push_back(builder.Build(row, static_cast<int>(readings.size())));
    fewer.Note(row, readings.back());
  }
  return readings;
}

// Euler angles without a convention are the one kind of unknown column that a person may have
// meant.
template <class Names>
std::string EulerHint(const Names& extra) {
  for (const std::string& name : extra) {
    if (name.starts_with("rx_"))
      return " (rx_, ry_, rz_ are used when --euler names their convention)";
  }
  return "";
}

void AddWarnings(const Columns& columns, const Repeats& repeats, const FewerCoordinates& fewer,
                 const SessionFileOptions& options, std::string_view file_name, SessionFile& file) {
  std::vector<std::string> extra;
  for (const std::string& name : file.session.extra_columns()) {
    if (std::ranges::find(options.used_columns, name) == options.used_columns.end())
      extra.push_back(name);
  }
  if (!extra.empty()) {
    file.warnings.push_back(StrCat(file_name, ": columns that are kept but not used: ",
                                   absl::StrJoin(extra, ", "), EulerHint(extra)));
  }
  if (!options.euler.empty() && columns.Find(Quantity::kEuler) == nullptr) {
    file.warnings.push_back(
        StrCat(file_name, ": no columns rx_, ry_, rz_ for the convention ", options.euler));
  }
  if (auto warning = repeats.Warning(file_name)) file.warnings.push_back(*std::move(warning));
  if (auto warning = fewer.Warning(file_name)) file.warnings.push_back(*std::move(warning));
}

}  // namespace

absl::StatusOr<SessionFile> ReadSessionFile(const std::string& path, const v1::Nominal& nominal,
                                            const SessionFileOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(path, kMostBytes));
  return ParseSessionFile(text, path, nominal, options);
}

absl::StatusOr<SessionFile> ParseSessionFile(std::string_view text, std::string_view file_name,
                                             const v1::Nominal& nominal,
                                             const SessionFileOptions& options) {
  FaultList faults;
  const std::optional<EulerConvention> euler = Convention(options, faults);
  const CsvTable table = ParseCsv(text, file_name, faults);
  if (table.header.cells.empty()) return faults.ToStatus();
  const auto known = SessionColumns(nominal, !options.euler.empty());
  const Columns columns(table.header, known, file_name, faults);
  const std::string header = StrCat(file_name, ":", table.header.line);
  CheckHasJoints(columns, nominal, header, faults);
  CheckDeviationColumns(columns, header, faults);
  const RowReader reader(table, columns, file_name, faults);
  ReadingBuilder builder(reader, columns, euler);
  Repeats repeats;
  FewerCoordinates fewer(columns);
  SessionFile file;
  file.session.set_source(std::string(BaseName(file_name)));
  for (const Column& column : columns.extra()) file.session.add_extra_columns(column.name);
  file.readings = ReadRows(table, builder, repeats, fewer, faults);
  if (file.readings.empty() && faults.empty()) {
    faults.Add(std::string(file_name), "no rows under the header", "at least one reading");
  }
  if (!faults.empty()) return faults.ToStatus();
  AddWarnings(columns, repeats, fewer, options, file_name, file);
  return file;
}

}  // namespace truepose::formats
