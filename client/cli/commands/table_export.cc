// truepose table export: the nodes of a table, for other programs.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "client/cli/commands/table.h"
#include "client/cli/json.h"
#include "client/cli/output_file.h"
#include "client/cli/table_text.h"
#include "convert/table_header.h"
#include "core/base/status_macros.h"
#include "core/compensation/table_error.h"
#include "core/compensation/table_nodes.h"

namespace truepose::cli {
namespace {

using compensation::kNodeFloats;
using compensation::Table;

struct Options {
  std::string table, output;
};

std::vector<std::string> Coordinates(const Table& table) {
  const v1::CompensationTableHeader header = convert::HeaderToProto(table);
  const TableDomain domain = DomainOfTable(table);
  std::vector<std::string> names;
  for (int k = 0; k < header.axes_size(); ++k)
    names.push_back(absl::StrCat(absl::StrReplaceAll(CoordinateText(header.axes(k)), {{" ", ""}}),
                                 domain.axes.IsLength(k) ? "_m" : "_rad"));
  return names;
}

// One node: its place with all digits, and six floats, which nine digits hold exactly.
struct Row {
  std::vector<std::string> place, twist;
};

Row RowOf(const Table& table, const NodeGrid& grid, int64_t node) {
  const NodeGrid::Place place = grid.PlaceOf(node);
  Row row;
  for (int k = 0; k < grid.joints(); ++k)
    row.place.push_back(absl::StrFormat("%.17g", grid.ValueAt(k, place[static_cast<size_t>(k)])));
  for (int i = 0; i < kNodeFloats; ++i)
    row.twist.push_back(
        absl::StrFormat("%.9g", table.nodes[static_cast<size_t>(node * kNodeFloats + i)]));
  return row;
}

std::string Csv(const Table& table) {
  const NodeGrid grid(table.axis, table.header.joints);
  std::string text = absl::StrCat(absl::StrJoin(Coordinates(table), ","),
                                  ",tx_m,ty_m,tz_m,rx_rad,ry_rad,rz_rad\n");
  for (int64_t node = 0; node < grid.size(); ++node) {
    const Row row = RowOf(table, grid, node);
    absl::StrAppend(&text, absl::StrJoin(row.place, ","), ",", absl::StrJoin(row.twist, ","), "\n");
  }
  return text;
}

absl::StatusOr<std::string> Json(const Table& table) {
  const NodeGrid grid(table.axis, table.header.joints);
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string header, ToJson(convert::HeaderToProto(table)));
  std::string text = absl::StrCat("{\"header\":", header, ",\"coordinates\":[\"",
                                  absl::StrJoin(Coordinates(table), "\",\""), "\"],\"nodes\":[");
  for (int64_t node = 0; node < grid.size(); ++node) {
    const Row row = RowOf(table, grid, node);
    absl::StrAppend(&text, node == 0 ? "" : ",", "{\"at\":[", absl::StrJoin(row.place, ","),
                    "],\"twist\":[", absl::StrJoin(row.twist, ","), "]}");
  }
  return text + "]}\n";
}

absl::Status Export(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const compensation::TableFile file, LoadTable(options.table));
  std::optional<OutputFile> output;
  if (!options.output.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(OutputFile created, OutputFile::Create(options.output, "--output"));
    output.emplace(std::move(created));
  }
  std::string text;
  if (invocation.json) {
    TRUEPOSE_ASSIGN_OR_RETURN(text, Json(file.table()));
  } else {
    text = Csv(file.table());
  }
  if (output) return output->Commit(text);
  invocation.console.out << text;
  return absl::OkStatus();
}

}  // namespace

void AddTableExport(const Command& table) {
  const auto options = std::make_shared<Options>();
  table.Add("export", "The nodes of a table as CSV, with --json as JSON")
      .Required("TABLE", "", &options->table, "File")
      .Option("-o,--output", "FILE", &options->output, "Default: standard output")
      .Footer(
          "A row a node: its coordinates (chain joints, of one that does not matter the middle of\n"
          "its range), then the correction of the flange as a twist "
          "(docs/formats.md).\n\nExamples:\n"
          "  truepose table export ur10.tpct --output ur10.nodes.csv\n"
          "  truepose table export ur10.tpct --json --output ur10.nodes.json")
      .Run(Command::Reach::kLocal,
           [options](const Invocation& invocation) { return Export(invocation, *options); });
}

}  // namespace truepose::cli
