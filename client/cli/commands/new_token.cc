#include "client/cli/commands/new_token.h"

#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/secret_file.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

std::string Text(const v1::CreateTokenResponse& made, const std::string& output) {
  const v1::Token& token = made.token();
  std::string text = absl::StrCat("Token ", token.name(), " of ", token.principal(),
                                  token.admin() ? ", an admin" : "", "\n");
  if (!output.empty())
    return absl::StrCat(text, "Its secret is in ", output, "\nNext: truepose status --token-file ",
                        output, "\n");
  return absl::StrCat(text, "Its secret, which nobody can tell again:\n", made.secret(),
                      "\nNext: put it into ~/.config/truepose/token with mode 0600\n");
}

}  // namespace

absl::Status PrintNewToken(
    const Invocation& invocation, const std::string& output, const Renaming& renaming,
    const std::function<absl::StatusOr<v1::CreateTokenResponse>(const client::Client&)>& make) {
  std::optional<SecretFile> file;
  if (!output.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(SecretFile made, SecretFile::Create(output, "--output"));
    file.emplace(std::move(made));
  }
  return WithServer(invocation, "", [&](const client::Client& client) -> absl::Status {
    absl::StatusOr<v1::CreateTokenResponse> answer = make(client);
    if (!answer.ok()) return RenameFields(answer.status(), renaming);
    v1::CreateTokenResponse made = *std::move(answer);
    if (file.has_value()) {
      TRUEPOSE_RETURN_IF_ERROR(file->Commit(made.secret()));
      made.clear_secret();
    }
    return Reply(invocation, made, [&] { return Text(made, output); });
  });
}

}  // namespace truepose::cli
