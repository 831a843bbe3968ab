// truepose status
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "client/cli/commands/commands.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kOpen[] =
    "Open to everybody (--dev-open): no tokens, whoever can connect is local-dev";

// As people there read it, or in UTC where this system does not know the zone.
std::string PlantTime(const v1::ServerStatus& status) {
  absl::TimeZone zone;
  if (!absl::LoadTimeZone(status.time_zone(), &zone)) return TimeText(status.server_time());
  const absl::Time now = absl::FromUnixSeconds(status.server_time().seconds());
  return absl::FormatTime("%Y-%m-%d %H:%M:%S", now, zone);
}

std::string CallerText(const v1::ServerStatus& status) {
  const std::string kind = absl::AsciiStrToLower(v1::PrincipalKind_Name(status.principal_kind()));
  return absl::StrCat(status.principal(), ", a ", kind, status.admin() ? " and admin" : "");
}

std::string StatusText(const v1::ServerStatus& status, const std::string& address,
                       const Console& console) {
  std::string text = absl::StrCat("Truepose ", status.version(), " at ", address, "\n");
  if (status.dev_open()) absl::StrAppend(&text, Paint(console, Colour::kYellow, kOpen), "\n");
  Table table({{"", Align::kLeft}, {"", Align::kLeft}});
  table.Add({"You are", CallerText(status)});
  table.Add({"Plant's time", absl::StrCat(PlantTime(status), ", ", status.time_zone())});
  table.Add({"Started", TimeText(status.start_time())});
  table.Add({"Store", absl::StrCat("revision ", status.revision(), " of ", status.epoch(), ", ",
                                   Fixed(1e-6 * status.database_bytes(), 1), " MB")});
  table.Add({"Holds", absl::StrCat(Count(status.robots(), "robot"), ", ",
                                   Count(status.sessions(), "session"), ", ",
                                   Count(status.readings(), "reading"))});
  table.Add({"Jobs",
             absl::StrCat(status.running_jobs(), " running, ", status.pending_jobs(), " waiting")});
  table.Add({"Open", absl::StrCat(Count(status.open_requests(), "recalibration request"), ", ",
                                  Count(status.watchers(), "watcher"))});
  const std::string rows = table.Text();
  // The table's line of titles is empty here.
  return absl::StrCat(text, rows.substr(rows.find('\n') + 1));
}

absl::Status Status(const Invocation& invocation) {
  return WithServer(invocation, "", [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::ServerStatus status, client.GetServerStatus({}));
    return Reply(invocation, status,
                 [&] { return StatusText(status, client.address(), invocation.console); });
  });
}

}  // namespace

void AddStatus(const Command& root) {
  root.Add("status", "How the server is, and who you are to it")
      .Footer("Examples:\n  truepose status\n  truepose status --json")
      .Run(Command::Reach::kRemote, Status);
}

}  // namespace truepose::cli
