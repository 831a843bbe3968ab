#include "client/uuid.h"

#include <array>
#include <random>

#include "absl/strings/str_format.h"

namespace truepose::client {

std::string RandomUuid() {
  std::random_device random;
  std::array<unsigned, 4> words;
  for (unsigned& word : words) word = random();
  words[1] = (words[1] & 0xFFFF0FFFu) | 0x00004000u;  // version 4
  words[2] = (words[2] & 0x3FFFFFFFu) | 0x80000000u;  // variant of RFC 4122
  return absl::StrFormat("%08x-%04x-%04x-%04x-%04x%08x", words[0], words[1] >> 16,
                         words[1] & 0xFFFFu, words[2] >> 16, words[2] & 0xFFFFu, words[3]);
}

}  // namespace truepose::client
