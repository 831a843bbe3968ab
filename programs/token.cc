#include "programs/token.h"

#include <algorithm>
#include <array>
#include <utility>

#include "absl/strings/ascii.h"

namespace truepose::programs {
namespace {

constexpr std::array<std::string_view, 6> kLongSigns = {":=", "==", "!=", "<=", ">=", "<>"};

class Tokenizer {
 public:
  Tokenizer(std::string_view text, const Lexis& lexis) : text_(text), lexis_(lexis) {}

  std::vector<Token> All() {
    while (at_ < text_.size()) Next();
    Add(TokenKind::kEnd, at_);
    return std::move(tokens_);
  }

 private:
  char At(size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  bool IsLineEnd(size_t i) const { return At(i) == '\n' || At(i) == '\r'; }

  bool StartsName(char c) const {
    return absl::ascii_isalpha(static_cast<unsigned char>(c)) || c == '_' ||
           (c != '\0' && lexis_.name_marks.find(c) != std::string_view::npos);
  }
  static bool IsDigit(char c) { return absl::ascii_isdigit(static_cast<unsigned char>(c)); }
  bool InName(char c) const { return StartsName(c) || IsDigit(c); }

  bool StartsNumber() const { return IsDigit(At(at_)) || (At(at_) == '.' && IsDigit(At(at_ + 1))); }

  bool StartsComment() const {
    if (At(at_) == lexis_.comment) return true;
    const bool first = at_ == 0 || IsLineEnd(at_ - 1);
    return lexis_.header != '\0' && first && At(at_) == lexis_.header;
  }

  void Add(TokenKind kind, size_t end) {
    tokens_.push_back({kind, line_, static_cast<uint32_t>(at_), static_cast<uint32_t>(end)});
    at_ = end;
  }

  void Next() {
    if (At(at_) == ' ' || At(at_) == '\t') {
      ++at_;
    } else if (IsLineEnd(at_)) {
      AddLineEnd();
    } else if (StartsComment()) {
      at_ = LineEndAfter(at_);
    } else if (At(at_) == '"') {
      AddText();
    } else if (StartsNumber()) {
      AddNumber();
    } else if (StartsName(At(at_))) {
      Add(TokenKind::kName, NameEndAfter(at_));
    } else {
      AddSign();
    }
  }

  void AddLineEnd() {
    Add(TokenKind::kLineEnd, at_ + (text_.substr(at_, 2) == "\r\n" ? 2 : 1));
    ++line_;
  }

  void AddSign() {
    const std::string_view two = text_.substr(at_, 2);
    const bool is_long = std::find(kLongSigns.begin(), kLongSigns.end(), two) != kLongSigns.end();
    Add(TokenKind::kSign, at_ + (is_long ? 2 : 1));
  }

  // 12abc and 0x1F are one thing that nobody should take for the number 12 or 0.
  void AddNumber() {
    const size_t end = NumberEnd();
    if (!StartsName(At(end)) && !(At(end) == '.')) return Add(TokenKind::kNumber, end);
    size_t rest = end;
    while (InName(At(rest)) || At(rest) == '.') ++rest;
    Add(TokenKind::kUnclear, rest);
  }

  size_t NumberEnd() const {
    size_t i = DigitsEnd(at_);
    if (At(i) == '.') i = DigitsEnd(i + 1);
    if (At(i) != 'e' && At(i) != 'E') return i;
    const size_t digits = i + 1 + (At(i + 1) == '+' || At(i + 1) == '-');
    return IsDigit(At(digits)) ? DigitsEnd(digits) : i;
  }

  size_t DigitsEnd(size_t i) const {
    while (IsDigit(At(i))) ++i;
    return i;
  }

  void AddText() {
    for (size_t i = at_ + 1; i < text_.size() && !IsLineEnd(i); ++i) {
      if (At(i) == '\\' && lexis_.backslash_unclear) break;
      if (At(i) != '"') continue;
      if (!lexis_.doubled_quotes || At(i + 1) != '"') return Add(TokenKind::kText, i + 1);
      ++i;
    }
    Add(TokenKind::kUnclear, LineEndAfter(at_));
  }

  size_t LineEndAfter(size_t i) const {
    while (i < text_.size() && !IsLineEnd(i)) ++i;
    return i;
  }

  size_t NameEndAfter(size_t i) const {
    while (InName(At(i))) ++i;
    return i;
  }

  const std::string_view text_;
  const Lexis lexis_;
  size_t at_ = 0;
  uint32_t line_ = 1;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> Tokenize(std::string_view text, const Lexis& lexis) {
  return Tokenizer(text, lexis).All();
}

}  // namespace truepose::programs
