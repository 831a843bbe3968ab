// Sessions that the server will take.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent {

// Whether it is a UUID in lower case, as session ids are.
bool IsUuid(const std::string& text);

// Every fault of what a source says of a session: names that can't be one, text that is no UTF-8,
// figures that are not finite, and fields that only the server sets.
absl::Status CheckSession(const v1::Session& content);

}  // namespace truepose::agent
