#include "server/auth/secret.h"

#include <unistd.h>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "server/store/checksum.h"

namespace truepose::auth {
namespace {

constexpr size_t kBytes = 32;

}  // namespace

absl::StatusOr<std::string> NewSecret() {
  char bytes[kBytes];
  if (getentropy(bytes, kBytes) != 0) return absl::InternalError("no random bytes of the system");
  return absl::StrCat("truepose-", absl::BytesToHexString(absl::string_view(bytes, kBytes)));
}

std::string HashOf(std::string_view secret) { return store::Sha256Hex(secret); }

}  // namespace truepose::auth
