// Text that a message can carry.
#pragma once

#include <string>
#include <string_view>

#include "core/base/fault.h"
#include "google/protobuf/message.h"

namespace truepose::agent {

// Whether `text` is well-formed UTF-8 (no overlong forms, no surrogates, at most U+10FFFF).
bool IsUtf8(std::string_view text);

// A fault for each string field of `message` and of messages in it that is not UTF-8: a message
// with one is written but can't be read.
void CheckText(const google::protobuf::Message& message, const std::string& field,
               FaultList* faults);

}  // namespace truepose::agent
