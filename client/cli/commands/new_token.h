// What the two commands that get a token do with its secret.
#pragma once

#include <functional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/cli/command_line.h"
#include "client/cli/outcome.h"
#include "client/client.h"
#include "truepose/v1/admin_services.pb.h"

namespace truepose::cli {

// Calls `make` and prints the token; its secret goes into the file `output` (made with mode 0600),
// or to standard output when there is none. It can't be had a second time.
// @param renaming of the fields of faults, to what people typed.
absl::Status PrintNewToken(
    const Invocation& invocation, const std::string& output, const Renaming& renaming,
    const std::function<absl::StatusOr<v1::CreateTokenResponse>(const client::Client&)>& make);

inline constexpr char kTokenOutputHelp[] =
    "New file for the secret, readable for you alone; default: it is printed";

}  // namespace truepose::cli
