// Secrets of tokens, as text, and what the store keeps of them.
//
// A secret has 256 bits of the system's generator. The slow, salted hashes of passwords exist
// because people choose passwords that can be guessed; 2^255 guesses on average cannot be made at
// any speed, and no two secrets are alike that a salt would have to tell apart. So one SHA-256 is
// enough, and cheap enough for each call. Finding a token is a look-up of the hash: how long it
// takes says nothing of the secret, because nobody can choose bits of a hash.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace truepose::auth {

// "truepose-" and 64 hex digits, so that people and scanners know one where they see it.
// @returns kInternal when the system gives no random bytes.
absl::StatusOr<std::string> NewSecret();

// SHA-256 in lower-case hex.
std::string HashOf(std::string_view secret);

}  // namespace truepose::auth
