// Program text cut into words, numbers and signs, for all dialects.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace truepose::programs {

enum class TokenKind : uint8_t {
  kName,     // letters, digits, _ and the dialect's further marks; begins with no digit
  kNumber,   // without a sign: 12, 1.5, .5, 9E+09
  kText,     // "..." within one line
  kSign,     // one character, or one of := == != <= >= <>
  kLineEnd,  // LF, CRLF or CR
  kUnclear,  // 0x1F, 12abc, or text in quotes whose end can't be told: the rest of its line
  kEnd,      // behind the last byte; always there
};

// Offsets into the text; programs have less than 4 GB.
struct Token {
  TokenKind kind;
  uint32_t line;  // counted from 1
  uint32_t begin;
  uint32_t end;
};

// What tokens depend on in a dialect.
struct Lexis {
  char comment;                      // from here to the line's end nothing is read
  char header = '\0';                // a line that begins so is a comment, too; '\0' = none
  std::string_view name_marks = "";  // besides letters, digits and _
  bool doubled_quotes = false;       // "" in quotes is a quote
  bool backslash_unclear = false;    // whether \" ends a text differs between versions
};

// Comments and blanks make no token. Any bytes are taken; those of no meaning become signs.
std::vector<Token> Tokenize(std::string_view text, const Lexis& lexis);

}  // namespace truepose::programs
