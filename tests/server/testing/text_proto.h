// Messages as text literals, in requests and in expectations.
#pragma once

#include <ostream>
#include <string>

#include "gmock/gmock.h"
#include "google/protobuf/text_format.h"
#include "google/protobuf/util/message_differencer.h"

namespace truepose::testing {

template <typename Message>
Message Parse(const std::string& text) {
  Message message;
  if (!google::protobuf::TextFormat::ParseFromString(text, &message)) {
    ADD_FAILURE() << "not a " << Message::descriptor()->full_name() << ": " << text;
  }
  return message;
}

// The fields of the text are in the message with these values; a repeated field is there as a
// whole. What the text leaves out (times, etags, digests) may be anything.
MATCHER_P(HasFields, text, "") {
  const auto expected = Parse<std::decay_t<decltype(arg)>>(text);
  google::protobuf::util::MessageDifferencer differencer;
  std::string difference;
  differencer.set_scope(google::protobuf::util::MessageDifferencer::PARTIAL);
  differencer.ReportDifferencesToString(&difference);
  if (differencer.Compare(expected, arg)) return true;
  *result_listener << difference;
  return false;
}

}  // namespace truepose::testing
