// The languages of robot programs that are understood.
#pragma once

#include <optional>
#include <string_view>

namespace truepose::programs {

enum class Dialect {
  kUrScript,  // Universal Robots
  kKrl,       // KUKA Robot Language
  kRapid,     // ABB
};

// "urscript", "krl", "rapid".
std::string_view NameOf(Dialect dialect);
std::optional<Dialect> DialectNamed(std::string_view name);

// By the extension, in upper or lower case: .script .urscript; .src .dat .sub; .mod .modx .prg
// .sys. nullopt for any other.
std::optional<Dialect> DialectOfFile(std::string_view path);

}  // namespace truepose::programs
