// SHA-256, as lower-case hex.
#pragma once

#include <string>
#include <string_view>

namespace truepose::store {

std::string Sha256Hex(std::string_view bytes);

// 128 random bits of the system as 32 hex digits.
std::string RandomHex128();

// A random UUID (version 4).
std::string NewUuid();

}  // namespace truepose::store
