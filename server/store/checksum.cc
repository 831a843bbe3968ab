#include "server/store/checksum.h"

#include <openssl/sha.h>

#include <cstdint>
#include <random>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"

namespace truepose::store {

std::string Sha256Hex(std::string_view bytes) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest);
  return absl::BytesToHexString(
      absl::string_view(reinterpret_cast<const char*>(digest), sizeof(digest)));
}

std::string RandomHex128() {
  // Not from a seeded generator: two databases must differ.
  std::random_device device;
  std::string hex;
  for (int i = 0; i < 4; ++i)
    absl::StrAppend(&hex, absl::Hex(static_cast<uint32_t>(device()), absl::kZeroPad8));
  return hex;
}

}  // namespace truepose::store
