// The tokens of one text, asked by their place: what every dialect's reader walks over.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "programs/program.h"
#include "programs/token.h"

namespace truepose::programs {

// A view into the text, which has to outlive it. Any place may be asked for: beyond the last token
// there is only the end.
class Words {
 public:
  Words(std::string_view text, const Lexis& lexis) : text_(text), tokens_(Tokenize(text, lexis)) {}

  const Token& At(size_t i) const { return tokens_[i < tokens_.size() ? i : tokens_.size() - 1]; }
  bool IsEnd(size_t i) const { return At(i).kind == TokenKind::kEnd; }
  bool Is(size_t i, TokenKind kind) const { return At(i).kind == kind; }
  bool IsSign(size_t i, std::string_view sign) const;
  // Whether nothing but the line's end comes there.
  bool EndsLine(size_t i) const { return Is(i, TokenKind::kLineEnd) || IsEnd(i); }

  std::string_view Text(size_t i) const;
  // The same in lower case, for dialects that don't tell the cases apart.
  std::string Lower(size_t i) const;
  int Line(size_t i) const { return static_cast<int>(At(i).line); }

  size_t SkipLineEnds(size_t i) const;

  // A number with or without a sign at `*i`, which moves behind it. Blanks may stand between sign
  // and number, nothing else. nullopt, and `*i` as it was, for anything else and for what
  // overflows.
  std::optional<JointNumber> ReadNumber(size_t* i, Unit unit) const;

 private:
  std::string_view text_;
  std::vector<Token> tokens_;
};

}  // namespace truepose::programs
