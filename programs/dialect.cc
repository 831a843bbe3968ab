#include "programs/dialect.h"

#include <array>
#include <string>
#include <utility>

#include "absl/strings/ascii.h"

namespace truepose::programs {
namespace {

constexpr std::array<std::pair<std::string_view, Dialect>, 3> kNames = {
    {{"urscript", Dialect::kUrScript}, {"krl", Dialect::kKrl}, {"rapid", Dialect::kRapid}}};

constexpr std::array<std::pair<std::string_view, Dialect>, 9> kExtensions = {
    {{"script", Dialect::kUrScript},
     {"urscript", Dialect::kUrScript},
     {"src", Dialect::kKrl},
     {"dat", Dialect::kKrl},
     {"sub", Dialect::kKrl},
     {"mod", Dialect::kRapid},
     {"modx", Dialect::kRapid},
     {"prg", Dialect::kRapid},
     {"sys", Dialect::kRapid}}};

template <class Table>
std::optional<Dialect> Find(const Table& table, std::string_view name) {
  for (const auto& [known, dialect] : table) {
    if (known == name) return dialect;
  }
  return std::nullopt;
}

}  // namespace

std::string_view NameOf(Dialect dialect) {
  for (const auto& [name, named] : kNames) {
    if (named == dialect) return name;
  }
  return "";
}

std::optional<Dialect> DialectNamed(std::string_view name) { return Find(kNames, name); }

std::optional<Dialect> DialectOfFile(std::string_view path) {
  const size_t dot = path.find_last_of("./");
  if (dot == std::string_view::npos || path[dot] != '.') return std::nullopt;
  std::string extension(path.substr(dot + 1));
  absl::AsciiStrToLower(&extension);
  return Find(kExtensions, extension);
}

}  // namespace truepose::programs
