#include "server/resource/filter.h"

#include <optional>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/resource/filter_tokens.h"
#include "server/resource/filter_value.h"

namespace truepose::resource {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Path = std::vector<const FieldDescriptor*>;
using Kind = FilterToken::Kind;

bool IsMessage(const FieldDescriptor* field) {
  return field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

// Every field but the last holds a message.
absl::StatusOr<Path> FindPath(const FilterToken& token, const Descriptor* descriptor) {
  Path path;
  const Descriptor* in = descriptor;
  for (const absl::string_view part : absl::StrSplit(token.text, '.')) {
    const FieldDescriptor* field = in == nullptr ? nullptr : in->FindFieldByName(std::string(part));
    if (field == nullptr || field->is_repeated()) {
      return FilterFault(token.column, absl::StrCat("'", token.text, "'"),
                         absl::StrCat("a field of ", descriptor->name(), " with one value"));
    }
    path.push_back(field);
    in = IsMessage(field) ? field->message_type() : nullptr;
  }
  return path;
}

bool Holds(const std::string& operation, int order) {
  if (operation == "=") return order == 0;
  if (operation == "!=") return order != 0;
  if (operation == "<") return order < 0;
  if (operation == "<=") return order <= 0;
  if (operation == ">") return order > 0;
  return order >= 0;
}

// Descends to the message that holds the last field.
const Message& Parent(const Message& message, const Path& path) {
  const Message* at = &message;
  for (size_t i = 0; i + 1 < path.size(); ++i) at = &at->GetReflection()->GetMessage(*at, path[i]);
  return *at;
}

absl::StatusOr<Predicate> ParseTerm(const FilterToken* token, size_t left,
                                    const Descriptor* descriptor) {
  if (token[0].kind != Kind::kWord)
    return FilterFault(token[0].column, absl::StrCat("'", token[0].text, "'"), "a field");
  TRUEPOSE_ASSIGN_OR_RETURN(const Path path, FindPath(token[0], descriptor));
  if (left < 2 || token[1].kind != Kind::kOperator || token[1].text == "!") {
    return FilterFault(token[0].column + token[0].text.size(), "no operator",
                       "= != < <= > or >= and a value");
  }
  if (left < 3 || token[2].kind == Kind::kOperator)
    return FilterFault(token[1].column + token[1].text.size(), "no value", "a value");
  const std::string operation = token[1].text;
  TRUEPOSE_ASSIGN_OR_RETURN(const Compare compare, MakeCompare(path.back(), token[2], operation));
  return Predicate([path, operation, compare](const Message& message) {
    const std::optional<int> order = compare(Parent(message, path));
    return order.has_value() ? Holds(operation, *order) : operation == "!=";
  });
}

}  // namespace

absl::StatusOr<Predicate> ParseFilter(const std::string& filter, const Descriptor* descriptor) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<FilterToken> tokens, SplitFilter(filter));
  std::vector<Predicate> terms;
  for (size_t at = 0; at < tokens.size(); at += 4) {
    TRUEPOSE_ASSIGN_OR_RETURN(Predicate term,
                              ParseTerm(&tokens[at], tokens.size() - at, descriptor));
    terms.push_back(std::move(term));
    const bool ends = at + 3 == tokens.size();
    if (!ends && (tokens[at + 3].text != "AND" || at + 4 == tokens.size())) {
      return FilterFault(tokens[at + 3].column, absl::StrCat("'", tokens[at + 3].text, "'"),
                         "AND and another term, or the end");
    }
  }
  return Predicate([terms](const Message& message) {
    for (const Predicate& term : terms) {
      if (!term(message)) return false;
    }
    return true;
  });
}

std::optional<std::string> TextAskedFor(const std::string& filter, const std::string& field) {
  const auto tokens = SplitFilter(filter);
  if (!tokens.ok()) return std::nullopt;
  for (size_t at = 0; at + 2 < tokens->size(); at += 4) {
    const FilterToken* term = &(*tokens)[at];
    const bool plain = term[2].kind == Kind::kText && !absl::StrContains(term[2].text, '*');
    if (term[0].text == field && term[1].text == "=" && plain) return term[2].text;
  }
  return std::nullopt;
}

}  // namespace truepose::resource
