#include "client/cli/commands/table_remote.h"

#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "client/cli/commands/download.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/commands/table_names.h"
#include "client/cli/commands/wait.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "client/cli/verdict.h"
#include "client/pager.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kDryRun[] = "Dry run: nothing was changed.\n";
constexpr char kTableHint[] = "`truepose table list` shows the tables of this server.";

std::string StateText(const v1::CompensationTable& table) {
  const std::string name = v1::CompensationTableState_Name(table.state());
  const std::string state = absl::AsciiStrToLower(name.substr(std::string("TABLE_").size()));
  return table.has_delete_time() ? state + ", deleted" : state;
}

std::string Millimetres(double m) { return absl::StrCat(Fixed(1e3 * m, 4), " mm"); }
std::string Degrees(double rad) {
  return absl::StrCat(Fixed(rad * 180.0 / std::numbers::pi, 5), " deg");
}
std::string Megabytes(int64_t bytes) {
  return absl::StrFormat("%.2f MB", static_cast<double>(bytes) / (1 << 20));
}

std::string ErrorText(const v1::CompensationTableHeader& header) {
  const v1::CompensationTableError& error = header.verified();
  return absl::StrCat("Verified at ", Count(header.verification_points(), "point"), ": worst ",
                      Millimetres(error.worst_position_m()), ", ",
                      Degrees(error.worst_rotation_rad()), "; 95 % within ",
                      Millimetres(error.position_95_m()), ", ", Degrees(error.rotation_95_rad()),
                      "\n");
}

std::string AccuracyText(const v1::CompensationTableHeader& header) {
  std::string text;
  if (header.has_predicted_accuracy_95_m())
    absl::StrAppend(&text, "Predicted accuracy of the tool, 95 %: ",
                    Millimetres(header.predicted_accuracy_95_m()), "\n");
  return absl::StrCat(text, "Refused near singularities: ",
                      absl::StrFormat("%.1f %%", 100.0 * header.near_singular_share()),
                      " of the domain\n");
}

// The same spec fails again: what to change, where it is, and how to try it.
std::string NextOfFailed(const v1::CompensationTable& table) {
  const std::string robot = ShortName(RobotOf(table.calibration()));
  return absl::StrCat(
      "Next: change the spec in what is said here; truepose table estimate --robot ", robot,
      " --spec FILE tries one.\n      Then truepose table build --robot ", robot,
      " --spec FILE; for the tables that follow activations truepose robot update ", robot,
      " --table-spec FILE\n");
}

std::string TableText(const v1::CompensationTable& table) {
  std::string text = absl::StrCat("Table ", ShortTable(table.name()), " of ",
                                  ShortName(table.calibration()), ": ", StateText(table), "\n");
  if (table.state() == v1::TABLE_FAILED)
    return absl::StrCat(text, table.error().message(), "\n", NextOfFailed(table));
  if (table.state() == v1::TABLE_BUILDING)
    return absl::StrCat(text, "Next: truepose job watch ", ShortName(table.job()), "\n");
  return absl::StrCat(text, Megabytes(table.size_bytes()), ", SHA-256 ", table.sha256(), "\n",
                      ErrorText(table.header()), AccuracyText(table.header()),
                      "Next: truepose table download ", ShortTable(table.name()),
                      " --output table.tpct\n");
}

std::string EstimateText(const v1::CompensationTable& table) {
  const v1::CompensationTableEstimate& estimate = table.estimate();
  return absl::StrCat(
      "A table of ", ShortName(table.calibration()), ": ", absl::StrJoin(estimate.nodes(), " x "),
      " nodes, ", Megabytes(estimate.size_bytes()), "; worst error estimated ",
      Millimetres(estimate.position_m()), ", ", Degrees(estimate.rotation_rad()), "\n");
}

std::string TablesTable(const v1::ListCompensationTablesResponse& list) {
  if (list.compensation_tables().empty())
    return "No tables. Next: truepose table build --robot NAME\n";
  Table rows({{"table", Align::kLeft},
              {"calibration", Align::kLeft},
              {"state", Align::kLeft},
              {"size"},
              {"worst mm"},
              {"worst deg"},
              {"created", Align::kLeft}});
  for (const v1::CompensationTable& table : list.compensation_tables()) {
    const bool ready = table.state() == v1::TABLE_READY;
    const v1::CompensationTableError& error = table.header().verified();
    rows.Add({ShortTable(table.name()), ShortName(table.calibration()), StateText(table),
              ready ? Megabytes(table.size_bytes()) : "",
              ready ? Fixed(1e3 * error.worst_position_m(), 4) : "",
              ready ? Fixed(error.worst_rotation_rad() * 180.0 / std::numbers::pi, 5) : "",
              TimeText(table.create_time())});
  }
  return rows.Text();
}

// What is asked of the reader is an option, too.
absl::Status WithOptionNames(const absl::Status& status) {
  FaultList faults;
  for (Fault fault : FaultsOf(status)) {
    fault.expected = absl::StrReplaceAll(fault.expected, {{"allow_draft", "--allow-draft"}});
    faults.Add(std::move(fault));
  }
  return faults.empty() ? status : WithFaults(status, faults);
}

// Faults name fields of the request; people typed options.
absl::Status AsTyped(const absl::Status& status, const RemoteTable& wanted) {
  return AsFaultOfVerdict(
      WithOptionNames(RenameFields(status, {{"compensation_table.spec.", wanted.spec_place},
                                            {"compensation_table.calibration", "--calibration"},
                                            {"parent", "--robot"}})));
}

absl::StatusOr<v1::CreateCompensationTableRequest> RequestOf(const RemoteTable& wanted) {
  v1::CreateCompensationTableRequest request;
  v1::CompensationTable& table = *request.mutable_compensation_table();
  if (!wanted.calibration.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(*table.mutable_calibration(), CalibrationName(wanted.calibration));
  } else if (wanted.robot.empty()) {
    return UsageError("give --calibration, or --robot for its active one");
  }
  request.set_parent(wanted.robot.empty() ? RobotOf(table.calibration()) : RobotName(wanted.robot));
  request.set_compensation_table_id(RandomUuid());
  if (wanted.has_spec) *table.mutable_spec() = wanted.spec;
  request.set_allow_draft(wanted.allow_draft);
  return request;
}

// The file as the server has it, written when its digest is the table's.
absl::Status Fetch(const Invocation& invocation, const client::Client& client,
                   const v1::CompensationTable& table, const std::string& path) {
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile output, OutputFile::Create(path, "--output"));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string bytes,
                            DownloadWithBar(invocation, client, table.name(), table.sha256()));
  return output.Commit(bytes);
}

std::string WrittenText(const std::string& path) {
  return absl::StrCat("Written to ", path, "; `truepose table show ", path,
                      "` looks into it, without a server\n");
}

absl::Status Deliver(const Invocation& invocation, const client::Client& client,
                     const v1::CompensationTable& table, const std::string& output) {
  if (!output.empty()) TRUEPOSE_RETURN_IF_ERROR(Fetch(invocation, client, table, output));
  return Reply(invocation, table, [&] {
    return absl::StrCat(TableText(table), output.empty() ? "" : WrittenText(output));
  });
}

// The table is there whether its calibration can be read or not.
void WarnOfVerdictOf(const Console& console, const client::Client& client,
                     const std::string& calibration) {
  v1::GetCalibrationRequest request;
  request.set_name(calibration);
  const auto found = client.GetCalibration(request);
  if (found.ok()) WarnOfVerdict(console, found->report());
}

absl::Status BuildAndWait(const Invocation& invocation, const client::Client& client,
                          const RemoteTable& wanted) {
  const InterruptScope interrupt;
  TRUEPOSE_ASSIGN_OR_RETURN(const auto request, RequestOf(wanted));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CompensationTable table, client.CreateCompensationTable(request));
  if (wanted.no_wait) return Reply(invocation, table, [&] { return TableText(table); });
  if (table.state() == v1::TABLE_BUILDING) {
    TRUEPOSE_ASSIGN_OR_RETURN(
        const v1::CalibrationJob job,
        WaitWithProgress(invocation, client, table.job(), interrupt, "build"));
    TRUEPOSE_RETURN_IF_ERROR(StatusOfJob(job));
    TRUEPOSE_ASSIGN_OR_RETURN(table, FindTable(client, table.name()));
  }
  WarnOfVerdictOf(invocation.console, client, table.calibration());
  return Deliver(invocation, client, table, wanted.output);
}

absl::Status List(const Invocation& invocation, const ListOptions& options) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    v1::ListCompensationTablesRequest first;
    first.set_parent(RobotName(options.robot));
    SetListOptions(options, first);
    v1::ListCompensationTablesResponse all;
    TRUEPOSE_RETURN_IF_ERROR(AsListed(client::ForEachPage(
        first, [&](const auto& request) { return client.ListCompensationTables(request); },
        [&](const v1::ListCompensationTablesResponse& page) {
          all.MergeFrom(page);
          return absl::OkStatus();
        })));
    all.clear_next_page_token();
    return Reply(invocation, all, [&] { return TablesTable(all); });
  });
}

struct OneTable {
  std::string name, output, etag;
  bool validate_only = false;
};

absl::Status DownloadOne(const Invocation& invocation, const OneTable& options) {
  return WithServer(invocation, kTableHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTable table, FindTable(client, options.name));
    TRUEPOSE_RETURN_IF_ERROR(Fetch(invocation, client, table, options.output));
    return Reply(invocation, table, [&] {
      return absl::StrCat("Table ", ShortTable(table.name()), " of ",
                          ShortName(table.calibration()), ": ", Megabytes(table.size_bytes()),
                          ", SHA-256 ", table.sha256(), "\n", WrittenText(options.output));
    });
  });
}

absl::Status DeleteOne(const Invocation& invocation, const OneTable& options) {
  v1::DeleteCompensationTableRequest request;
  request.set_etag(options.etag);
  request.set_validate_only(options.validate_only);
  return WithServer(invocation, kTableHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTable found,
                              FindTableToChange(client, options.name, false));
    request.set_name(found.name());
    TRUEPOSE_ASSIGN_OR_RETURN(const auto table, client.DeleteCompensationTable(request));
    return Reply(invocation, table, [&] {
      if (options.validate_only)
        return absl::StrCat("Would delete table ", ShortTable(table.name()), "\n", kDryRun);
      return absl::StrCat("Deleted table ", ShortTable(table.name()), "\n`truepose table undelete ",
                          ShortTable(table.name()), "` brings it back within 7 days.\n");
    });
  });
}

absl::Status UndeleteOne(const Invocation& invocation, const OneTable& options) {
  v1::UndeleteCompensationTableRequest request;
  request.set_validate_only(options.validate_only);
  return WithServer(invocation, kTableHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTable found,
                              FindTableToChange(client, options.name, true));
    request.set_name(found.name());
    TRUEPOSE_ASSIGN_OR_RETURN(const auto table, client.UndeleteCompensationTable(request));
    return Reply(invocation, table, [&] {
      return options.validate_only
                 ? absl::StrCat("Would bring back table ", ShortTable(table.name()), "\n", kDryRun)
                 : TableText(table);
    });
  });
}

void AddList(const Command& group) {
  const auto options = std::make_shared<ListOptions>();
  const Command list = group.Add("list", "List the tables of a server");
  AddListOptions(list, {.robot = true, .deleted = true, .example = "state = \"TABLE_READY\""},
                 options.get());
  list.Footer(
          "Examples:\n  truepose table list --robot ur10\n"
          "  truepose table list --filter 'state = \"TABLE_FAILED\"' --json")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return List(invocation, *options); });
}

void AddDownload(const Command& group) {
  const auto options = std::make_shared<OneTable>();
  group.Add("download", "Fetch a table's file from a server, and check it")
      .Required("TABLE", "", &options->name, kOneTable)
      .Required("--output", "FILE", &options->output, "Where the table goes")
      .Footer(
          "Examples:\n  truepose table download ur10 --output ur10.tpct\n  truepose table download "
          "ur10/5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11 --output ur10.tpct")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return DownloadOne(invocation, *options); });
}

void AddChange(const Command& group, const std::string& verb, const std::string& summary,
               absl::Status (*act)(const Invocation&, const OneTable&)) {
  const auto options = std::make_shared<OneTable>();
  const Command command = group.Add(verb, summary);
  command.Required("TABLE", "", &options->name, kTableToChange);
  if (verb == "delete")
    command.Option("--etag", "ETAG", &options->etag,
                   "Only if it is still in this state (of --json); default: whatever state");
  command
      .Option("--dry-run", "", &options->validate_only,
              "Only check it; nothing is changed (validate_only)")
      .Footer(absl::StrCat("Example:\n  truepose table ", verb,
                           " ur10/5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11"))
      .Run(Command::Reach::kRemote,
           [=](const Invocation& invocation) { return act(invocation, *options); });
}

}  // namespace

absl::Status BuildTableOnServer(const Invocation& invocation, const RemoteTable& wanted) {
  return WithServer(invocation, kCalibrationHint, [&](const client::Client& client) {
    return AsTyped(BuildAndWait(invocation, client, wanted), wanted);
  });
}

absl::Status EstimateTableOnServer(const Invocation& invocation, const RemoteTable& wanted) {
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(auto request, RequestOf(wanted));
        request.set_validate_only(true);
        const auto table = client.CreateCompensationTable(request);
        if (!table.ok()) return AsTyped(table.status(), wanted);
        return Reply(invocation, table->estimate(), [&] { return EstimateText(*table); });
      });
}

absl::Status ShowTableOnServer(const Invocation& invocation, const std::string& typed) {
  return WithServer(invocation, kTableHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTable table, FindTable(client, typed));
    return Reply(invocation, table, [&] { return TableText(table); });
  });
}

void AddTableOnServer(const Command& table) {
  AddList(table);
  AddDownload(table);
  AddChange(table, "delete", "Delete a table of a server", DeleteOne);
  AddChange(table, "undelete", "Bring a deleted table back", UndeleteOne);
}

}  // namespace truepose::cli
