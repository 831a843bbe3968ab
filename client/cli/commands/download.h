// Resources that are too big for one message, with a bar at a terminal.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "client/cli/command_line.h"
#include "client/client.h"
#include "core/base/status_macros.h"

namespace truepose::cli {

// The bytes of a resource by its name (client/download.h).
// @param sha256 the digest that they must have, "" = any.
absl::StatusOr<std::string> DownloadWithBar(const Invocation& invocation,
                                            const client::Client& client, const std::string& name,
                                            const std::string& sha256 = "");

template <typename Message>
absl::StatusOr<Message> DownloadWhole(const Invocation& invocation, const client::Client& client,
                                      const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string bytes, DownloadWithBar(invocation, client, name));
  Message message;
  if (message.ParseFromString(bytes)) return message;
  return absl::DataLossError("what was downloaded can't be read");
}

}  // namespace truepose::cli
