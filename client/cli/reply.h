// What a command answers: a message for programs, text for people.
#pragma once

#include <functional>
#include <string>

#include "absl/status/status.h"
#include "client/cli/command_line.h"
#include "google/protobuf/message.h"

namespace truepose::cli {

// On standard output: the JSON of `message` with --json, else `text()`.
absl::Status Reply(const Invocation& invocation, const google::protobuf::Message& message,
                   const std::function<std::string()>& text);

}  // namespace truepose::cli
