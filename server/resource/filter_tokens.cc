#include "server/resource/filter_tokens.h"

#include <cctype>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::resource {
namespace {

using Kind = FilterToken::Kind;

bool IsWordLetter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ||
         c == '+';
}

absl::StatusOr<FilterToken> ReadText(const std::string& filter, size_t& at) {
  FilterToken token{Kind::kText, "", at + 1};
  for (++at; at < filter.size() && filter[at] != '"'; ++at) {
    if (filter[at] == '\\' && at + 1 < filter.size()) ++at;
    token.text += filter[at];
  }
  if (at == filter.size())
    return FilterFault(token.column, "a text without an end", "a closing \"");
  ++at;
  return token;
}

FilterToken ReadWord(const std::string& filter, size_t& at) {
  FilterToken token{Kind::kWord, "", at + 1};
  while (at < filter.size() && IsWordLetter(filter[at])) token.text += filter[at++];
  return token;
}

FilterToken ReadOperator(const std::string& filter, size_t& at) {
  FilterToken token{Kind::kOperator, std::string(1, filter[at]), at + 1};
  ++at;
  if (at < filter.size() && filter[at] == '=' && token.text != "=") token.text += filter[at++];
  return token;
}

absl::StatusOr<FilterToken> ReadToken(const std::string& filter, size_t& at) {
  const char first = filter[at];
  if (first == '"') return ReadText(filter, at);
  if (std::string("=!<>").find(first) != std::string::npos) return ReadOperator(filter, at);
  if (IsWordLetter(first)) return ReadWord(filter, at);
  return FilterFault(at + 1, absl::StrCat("'", std::string(1, first), "'"),
                     "a field, an operator (= != < <= > >=), a value or AND");
}

}  // namespace

absl::Status FilterFault(size_t column, const std::string& found, const std::string& expected) {
  return FaultStatus("filter", absl::StrCat(found, " at column ", column), expected);
}

absl::StatusOr<std::vector<FilterToken>> SplitFilter(const std::string& filter) {
  std::vector<FilterToken> tokens;
  for (size_t at = 0; at < filter.size();) {
    if (std::isspace(static_cast<unsigned char>(filter[at])) != 0) {
      ++at;
      continue;
    }
    TRUEPOSE_ASSIGN_OR_RETURN(FilterToken token, ReadToken(filter, at));
    tokens.push_back(std::move(token));
  }
  return tokens;
}

}  // namespace truepose::resource
