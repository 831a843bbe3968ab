// truepose session export: the readings of a sealed session as a file that `session import` takes;
// and the download itself.
#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/download.h"
#include "client/cli/names.h"
#include "client/cli/output_file.h"
#include "client/cli/progress.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "client/download.h"
#include "convert/run.h"
#include "core/base/status_macros.h"
#include "formats/session_file.h"

namespace truepose::cli {
namespace {

absl::StatusOr<v1::Nominal> NominalOf(const client::Client& client, const v1::Session& session) {
  v1::GetNominalRevisionRequest request;
  request.set_name(session.nominal_revision());
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::NominalRevision revision, client.GetNominalRevision(request));
  return revision.nominal();
}

absl::Status Export(const Invocation& invocation, const std::string& typed,
                    const std::string& path) {
  return WithServer(invocation, kSessionHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(OutputFile output, OutputFile::Create(path, "--output"));
    TRUEPOSE_ASSIGN_OR_RETURN(
        const auto input, DownloadWhole<v1::SessionInput>(invocation, client, SessionName(typed)));
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Nominal nominal, NominalOf(client, input.session()));
    const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
    if (convert::ReadingsDigest(readings) != input.session().digest())
      return absl::DataLossError("the readings do not fit the digest with which they were sealed");
    TRUEPOSE_RETURN_IF_ERROR(
        output.Commit(formats::WriteSessionFile(nominal, input.session(), readings)));
    return Reply(invocation, input.session(), [&] {
      return absl::StrCat("Session ", ShortName(input.session().name()), ": ",
                          Count(input.readings_size(), "reading"), " in ", path, "\n");
    });
  });
}

}  // namespace

absl::StatusOr<std::string> DownloadWithBar(const Invocation& invocation,
                                            const client::Client& client, const std::string& name,
                                            const std::string& sha256) {
  ProgressBar bar(invocation.console, "download");
  client::DownloadOptions options;
  options.sha256 = sha256;
  options.on_progress = [&](int64_t have, int64_t total) {
    bar.Show(total == 0 ? 1.0 : static_cast<double>(have) / static_cast<double>(total),
             absl::StrFormat("%.1f of %.1f MB", 1e-6 * have, 1e-6 * total));
  };
  return client::Download(client, name, options);
}

void AddSessionExport(const Command& session) {
  const auto name = std::make_shared<std::string>();
  const auto output = std::make_shared<std::string>();
  session.Add("export", "Write the readings of a sealed session to a file")
      .Required("SESSION", "", name.get(), "UUID")
      .Required("--output", "FILE", output.get(), "CSV in m and rad, which reads back bit for bit")
      .Footer(
          "It goes on where it was when the connection breaks off.\n\nExample:\n"
          "  truepose session export 5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11 --output series_C.csv")
      .Run(Command::Reach::kRemote,
           [=](const Invocation& invocation) { return Export(invocation, *name, *output); });
}

}  // namespace truepose::cli
