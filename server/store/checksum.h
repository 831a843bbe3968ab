// SHA-256, as lower-case hex.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace truepose::store {

std::string Sha256Hex(std::string_view bytes);

// The same for bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void Add(std::string_view bytes);
  // Of all that was added. Once only.
  std::string Hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// 128 random bits of the system as 32 hex digits.
std::string RandomHex128();

// A random UUID (version 4).
std::string NewUuid();

}  // namespace truepose::store
