// Texts damaged by chance, for tests of readers.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <string_view>

namespace truepose::testing {

struct DamageManner {
  // Bytes that mean something to the reader, four of five: chance would hardly ever hit them.
  std::string_view likely;
  size_t most_places = 4;
  size_t longest = 20;  // of a piece that is doubled or taken out
};

// Damages a text at one place or more: bytes changed, put in, taken out; pieces doubled or cut off.
class Mutator {
 public:
  Mutator(uint64_t seed, const DamageManner& manner) : random_(seed), manner_(manner) {}

  std::string Damage(std::string text) {
    const size_t places = 1 + Below(manner_.most_places);
    for (size_t i = 0; i < places && !text.empty(); ++i) DamageOnce(&text);
    return text;
  }

 private:
  size_t Below(size_t n) { return random_() % n; }

  char Byte() {
    return Below(5) == 0 ? static_cast<char>(Below(256))
                         : manner_.likely[Below(manner_.likely.size())];
  }

  void DamageOnce(std::string* text) {
    const size_t at = Below(text->size());
    const size_t length = 1 + Below(std::min(text->size() - at, manner_.longest));
    switch (Below(6)) {
      case 0:
        (*text)[at] = Byte();
        break;
      case 1:
        text->insert(at, 1, Byte());
        break;
      case 2:
        text->erase(at, length);
        break;
      case 3:
        text->insert(Below(text->size()), text->substr(at, length));
        break;
      case 4:
        text->resize(at);
        break;
      default:
        text->insert(at, Below(50), Byte());
    }
  }

  std::mt19937_64 random_;
  DamageManner manner_;
};

}  // namespace truepose::testing
