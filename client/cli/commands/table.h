// What the sub-commands of `truepose table` share.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/cli/command_line.h"
#include "client/cli/inputs.h"
#include "client/cli/outcome.h"
#include "compensation/table_file.h"
#include "formats/message_file.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::cli {

// Of `estimate` and `build`: what a table is made from.
struct TableOptions {
  bool local = false;
  std::string robot, calibration;  // with --local files
  formats::UrdfEnds ends;
  std::string spec;              // a file
  std::vector<std::string> set;  // KEY=VALUE
  std::string output;
  bool allow_draft = false, no_wait = false;  // only without --local
};

// What shows of a spec without a robot (convert/table_spec.h), and that of two domains in `given`
// only the latter is in the message. Faults in the units that were written, `place` before each.
absl::Status CheckTableSpec(const v1::CompensationTableSpec& spec,
                            const formats::GivenFields& given, const std::string& place);

// --spec and --set.
void AddTableSpecOptions(const Command& command, TableOptions* options);
// What --help says of them.
extern const char kTableSpecHelp[];

// The file first, then --set over it; empty where neither is given.
// @returns every fault, with file and line or key.
absl::StatusOr<v1::CompensationTableSpec> LoadTableSpec(const TableOptions& options);

// The same message as a server's job has.
absl::StatusOr<v1::CompensationTableInput> LoadTableInput(const TableOptions& options);

// What stands before the faults of a spec: "--spec: ", or "--set: " where no file was named.
std::string SpecPlace(const TableOptions& options);

// Faults of the spec name fields of the message; people typed options.
// @param place as SpecPlace.
Renaming TableFields(const std::string& place);

// A file that is whole and intact, or a fault of it that says why not.
absl::StatusOr<compensation::TableFile> LoadTable(const std::string& path);

// The estimate in a line or two.
std::string EstimateText(const v1::CompensationTableEstimate& estimate);

void AddTableEstimate(const Command& table);
void AddTableBuild(const Command& table);
void AddTableShow(const Command& table);
void AddTableVerify(const Command& table);
void AddTableExport(const Command& table);

}  // namespace truepose::cli
