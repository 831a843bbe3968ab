#include "client/agent/intake/utf8.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"

namespace truepose::agent {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Bytes of the sequence that `first` begins; 0 when none can.
int SequenceSize(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 0;
}

// What the first byte allows as second: no overlong form, no surrogate, nothing above U+10FFFF.
bool IsSecond(unsigned char first, unsigned char second) {
  const unsigned char least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  return second >= least && second <= most;
}

bool IsContinuation(unsigned char byte) { return (byte & 0xC0) == 0x80; }

void CheckField(const Message& message, const FieldDescriptor& field, const std::string& path,
                FaultList* faults) {
  const auto& reflection = *message.GetReflection();
  const int size = field.is_repeated() ? reflection.FieldSize(message, &field) : 1;
  for (int i = 0; i < size; ++i) {
    const std::string place = field.is_repeated() ? absl::StrCat(path, "[", i, "]") : path;
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      CheckText(field.is_repeated() ? reflection.GetRepeatedMessage(message, &field, i)
                                    : reflection.GetMessage(message, &field),
                place, faults);
    } else if (field.type() == FieldDescriptor::TYPE_STRING) {
      const std::string text = field.is_repeated()
                                   ? reflection.GetRepeatedString(message, &field, i)
                                   : reflection.GetString(message, &field);
      if (!IsUtf8(text)) faults->Add(place, "bytes that are no UTF-8", "text in UTF-8");
    }
  }
}

}  // namespace

bool IsUtf8(std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const int size = SequenceSize(first);
    if (size == 0 || at + static_cast<size_t>(size) > text.size()) return false;
    if (size > 1 && !IsSecond(first, static_cast<unsigned char>(text[at + 1]))) return false;
    for (int i = 2; i < size; ++i)
      if (!IsContinuation(static_cast<unsigned char>(text[at + static_cast<size_t>(i)])))
        return false;
    at += static_cast<size_t>(size);
  }
  return true;
}

void CheckText(const Message& message, const std::string& field, FaultList* faults) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* set : fields)
    CheckField(message, *set, absl::StrCat(field, ".", set->name()), faults);
}

}  // namespace truepose::agent
