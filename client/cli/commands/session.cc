// truepose session list|show; the others are files of their own
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/commands/resource.h"
#include "client/cli/names.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "client/pager.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

std::string StateText(const v1::Session& session) {
  return session.state() == v1::SEALED ? "sealed" : "open";
}

std::string SessionsTable(const v1::ListSessionsResponse& list) {
  if (list.sessions().empty())
    return "No sessions. Next: truepose session import FILE.csv --robot NAME\n";
  Table table({{"session", Align::kLeft},
               {"robot", Align::kLeft},
               {"name", Align::kLeft},
               {"readings"},
               {"state", Align::kLeft},
               {"created", Align::kLeft}});
  for (const v1::Session& session : list.sessions()) {
    table.Add({ShortName(session.name()), ShortName(session.robot()), session.display_name(),
               absl::StrCat(session.reading_count()), StateText(session),
               TimeText(session.create_time())});
  }
  return table.Text();
}

absl::Status List(const Invocation& invocation, const ListOptions& options) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    v1::ListSessionsRequest first;
    first.set_robot(RobotName(options.robot));
    SetListOptions(options, first);
    v1::ListSessionsResponse all;
    TRUEPOSE_RETURN_IF_ERROR(AsListed(client::ForEachPage(
        first, [&](const auto& request) { return client.ListSessions(request); },
        [&](const v1::ListSessionsResponse& page) {
          all.MergeFrom(page);
          return absl::OkStatus();
        })));
    all.clear_next_page_token();
    return Reply(invocation, all, [&] { return SessionsTable(all); });
  });
}

// How it was measured, as far as that is known.
std::string MeasuredText(const v1::Session& session) {
  std::string text;
  const auto add = [&](const char* title, const std::string& value) {
    if (!value.empty()) absl::StrAppend(&text, "  ", title, value, "\n");
  };
  add("instrument ", ShortName(session.instrument()));
  add("placement  ", session.placement());
  add("fixture    ", ShortName(session.fixture()));
  add("operator   ", session.operator_());
  add("joints     ", session.joint_source());
  add("at         ",
      session.has_temperature_c() ? absl::StrCat(Fixed(session.temperature_c(), 1), " deg C") : "");
  add("load       ", session.has_load_kg() ? absl::StrCat(session.load_kg(), " kg") : "");
  return text;
}

std::string SessionText(const v1::Session& session) {
  std::string text = absl::StrCat(
      "Session ", ShortName(session.name()), " (", session.display_name(), ")\n  robot    ",
      ShortName(session.robot()), ", nominal ", session.nominal_revision(), "\n  readings ",
      session.reading_count(), ", ", StateText(session), "\n  source   ", session.source(),
      "\n  created  ", TimeText(session.create_time()), "\n");
  if (session.state() == v1::SEALED) {
    absl::StrAppend(&text, "  sealed   ", TimeText(session.seal_time()), ", SHA-256 ",
                    session.digest(), "\n");
  }
  if (!session.extra_columns().empty()) {
    absl::StrAppend(&text, "  also     ", absl::StrJoin(session.extra_columns(), ", "), "\n");
  }
  return absl::StrCat(text, MeasuredText(session));
}

absl::Status Show(const Invocation& invocation, const std::string& name) {
  return WithServer(invocation, kSessionHint, [&](const client::Client& client) -> absl::Status {
    v1::GetSessionRequest request;
    request.set_name(SessionName(name));
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session, client.GetSession(request));
    return Reply(invocation, session, [&] { return SessionText(session); });
  });
}

}  // namespace

void AddSession(const Command& root) {
  const Command session = root.Add("session", "Measurement sessions");
  session.Footer("Example:\n  truepose session list --robot ur10");
  AddSessionImport(session);
  const auto options = std::make_shared<ListOptions>();
  const Command list = session.Add("list", "List the sessions");
  AddListOptions(list, {.robot = true, .deleted = true, .example = "state = \"SEALED\""},
                 options.get());
  list.Footer(
          "Examples:\n  truepose session list\n"
          "  truepose session list --robot ur10 --filter 'purpose = \"CHECK\"' --json")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return List(invocation, *options); });
  const auto name = std::make_shared<std::string>();
  session.Add("show", "Show one session")
      .Required("SESSION", "", name.get(), "UUID")
      .Footer("Example:\n  truepose session show 5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11")
      .Run(Command::Reach::kRemote,
           [name](const Invocation& invocation) { return Show(invocation, *name); });
  AddSessionExport(session);
  AddResourceChanges(session, SessionKindOfResource());
}

}  // namespace truepose::cli
