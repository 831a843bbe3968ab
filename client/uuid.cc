#include "client/uuid.h"

#include <array>
#include <cstdint>
#include <random>

#include "absl/strings/str_format.h"
#include "openssl/sha.h"

namespace truepose::client {
namespace {

std::string ToText(std::array<uint32_t, 4> words, uint32_t version) {
  words[1] = (words[1] & 0xFFFF0FFFu) | version << 12;
  words[2] = (words[2] & 0x3FFFFFFFu) | 0x80000000u;  // variant of RFC 4122
  return absl::StrFormat("%08x-%04x-%04x-%04x-%04x%08x", words[0], words[1] >> 16,
                         words[1] & 0xFFFFu, words[2] >> 16, words[2] & 0xFFFFu, words[3]);
}

}  // namespace

std::string RandomUuid() {
  std::random_device random;
  std::array<uint32_t, 4> words;
  for (uint32_t& word : words) word = random();
  return ToText(words, 4);
}

std::string NamedUuid(std::string_view name) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  SHA256(reinterpret_cast<const unsigned char*>(name.data()), name.size(), digest.data());
  std::array<uint32_t, 4> words{};
  for (size_t i = 0; i < 16; ++i) words[i / 4] = words[i / 4] << 8 | digest[i];
  return ToText(words, 8);
}

}  // namespace truepose::client
