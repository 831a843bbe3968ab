// truepose token create|list|revoke
#include <memory>
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/new_token.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "client/pager.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kTokenHint[] = "`truepose token list` shows the tokens of this server.";
constexpr int kMostDays = 36'500;

struct CreateOptions {
  std::string principal, kind = "person", expires, output;
  bool admin = false;
};

// "90d", or a date, whose begin in UTC it is.
absl::StatusOr<absl::Time> ParseExpiry(const std::string& text) {
  int days = 0;
  if (absl::EndsWith(text, "d") && absl::SimpleAtoi(text.substr(0, text.size() - 1), &days) &&
      days > 0 && days <= kMostDays) {
    return absl::Now() + days * absl::Hours(24);
  }
  absl::Time time;
  std::string error;
  if (absl::ParseTime("%Y-%m-%d", text, &time, &error)) return time;
  return OptionFault("--expires", text, "days such as 90d, or a date such as 2027-01-31");
}

absl::StatusOr<v1::CreateTokenRequest> ToRequest(const CreateOptions& options) {
  v1::CreateTokenRequest request;
  v1::Token& token = *request.mutable_token();
  token.set_principal(options.principal);
  token.set_admin(options.admin);
  if (options.kind != "person" && options.kind != "machine")
    return OptionFault("--kind", options.kind, "person or machine");
  token.set_kind(options.kind == "person" ? v1::PERSON : v1::MACHINE);
  if (options.expires.empty()) return request;
  TRUEPOSE_ASSIGN_OR_RETURN(const absl::Time time, ParseExpiry(options.expires));
  token.mutable_expire_time()->set_seconds(absl::ToUnixSeconds(time));
  return request;
}

absl::Status Create(const Invocation& invocation, const CreateOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CreateTokenRequest request, ToRequest(options));
  return PrintNewToken(invocation, options.output,
                       {{"token.expire_time", "--expires"}, {"token.", "--"}},
                       [&](const client::Client& client) { return client.CreateToken(request); });
}

std::string StateText(const v1::Token& token) {
  if (token.has_revoke_time()) return absl::StrCat("revoked ", TimeText(token.revoke_time()));
  if (!token.has_expire_time()) return "holds";
  const bool over = absl::FromUnixSeconds(token.expire_time().seconds()) <= absl::Now();
  return absl::StrCat(over ? "expired " : "until ", TimeText(token.expire_time()));
}

std::string TokensTable(const v1::ListTokensResponse& list) {
  if (list.tokens().empty()) return "No tokens. Next: truepose admin bootstrap FILE\n";
  Table table({{"token", Align::kLeft},
               {"principal", Align::kLeft},
               {"kind", Align::kLeft},
               {"state", Align::kLeft},
               {"created", Align::kLeft},
               {"by", Align::kLeft},
               {"last used", Align::kLeft}});
  for (const v1::Token& token : list.tokens()) {
    const std::string kind = absl::AsciiStrToLower(v1::PrincipalKind_Name(token.kind()));
    table.Add({ShortName(token.name()), token.principal(),
               token.admin() ? absl::StrCat(kind, ", admin") : kind, StateText(token),
               TimeText(token.create_time()), token.created_by(),
               token.has_last_use_time() ? TimeText(token.last_use_time()) : "never"});
  }
  return table.Text();
}

absl::Status List(const Invocation& invocation) {
  return WithServer(invocation, "", [&](const client::Client& client) -> absl::Status {
    v1::ListTokensResponse all;
    TRUEPOSE_RETURN_IF_ERROR(client::ForEachPage(
        v1::ListTokensRequest(), [&](const auto& request) { return client.ListTokens(request); },
        [&](const v1::ListTokensResponse& page) {
          all.MergeFrom(page);
          return absl::OkStatus();
        }));
    all.clear_next_page_token();
    return Reply(invocation, all, [&] { return TokensTable(all); });
  });
}

absl::Status Revoke(const Invocation& invocation, const std::string& name) {
  return WithServer(invocation, kTokenHint, [&](const client::Client& client) -> absl::Status {
    v1::RevokeTokenRequest request;
    request.set_name(TokenName(name));
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Token token, client.RevokeToken(request));
    return Reply(invocation, token, [&] {
      return absl::StrCat("Token ", ShortName(token.name()), " of ", token.principal(), ": ",
                          StateText(token), "\n");
    });
  });
}

void AddCreate(const Command& token) {
  const auto options = std::make_shared<CreateOptions>();
  token.Add("create", "Make a token for a person or a machine; admins only")
      .Required("--principal", "NAME", &options->principal, "Who shows it, such as ben or cell-7")
      .Option("--kind", "KIND", &options->kind,
              "person (the default), or machine: it measures and calibrates, and never releases")
      .Option("--admin", "", &options->admin, "May create and revoke tokens")
      .Option("--expires", "WHEN", &options->expires, "90d or 2027-01-31; default: never")
      .Option("--output", "FILE", &options->output, kTokenOutputHelp)
      .Footer(
          "Examples:\n  truepose token create --principal ben --expires 365d --output ben.token\n"
          "  truepose token create --principal cell-7 --kind machine --output cell-7.token")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Create(invocation, *options); });
}

}  // namespace

void AddToken(const Command& root) {
  const Command token = root.Add("token", "Who may call the server");
  token.Footer("Example:\n  truepose token list");
  AddCreate(token);
  token.Add("list", "List the tokens, without their secrets; admins only")
      .Footer("Examples:\n  truepose token list\n  truepose token list --json")
      .Run(Command::Reach::kRemote, List);
  const auto name = std::make_shared<std::string>();
  token.Add("revoke", "End a token; admins only")
      .Required("TOKEN", "", name.get(), "UUID")
      .Footer("Example:\n  truepose token revoke 0d5a9e1c-52a8-4d6c-8f0a-3a1f1a6a8f11")
      .Run(Command::Reach::kRemote,
           [name](const Invocation& invocation) { return Revoke(invocation, *name); });
}

}  // namespace truepose::cli
