#include "client/agent/lines/json_fields.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace truepose::agent {

bool IsDeeperThan(const std::string& line, int most) {
  int depth = 0;
  bool in_text = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > most) return true;
  }
  return false;
}

std::string FoundText(const Json& value) {
  constexpr size_t kMost = 60;
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kMost) text = text.substr(0, kMost) + "...";
  return text;
}

void JsonFields::AddFault(const char* key, std::string found, std::string expected) {
  faults_.Add(key, std::move(found), std::move(expected));
}

const Json* JsonFields::Find(const char* key) {
  asked_.insert(key);
  const auto found = object_.find(key);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

std::optional<std::string> JsonFields::Text(const char* key) {
  const Json* const value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (value->is_string()) return value->get<std::string>();
  AddFault(key, FoundText(*value), "a text");
  return std::nullopt;
}

std::optional<double> JsonFields::Number(const char* key) {
  const Json* const value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (value->is_number()) return value->get<double>();
  AddFault(key, FoundText(*value), "a number");
  return std::nullopt;
}

std::optional<int64_t> JsonFields::Whole(const char* key) {
  const Json* const value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (value->is_number_integer()) return value->get<int64_t>();
  AddFault(key, FoundText(*value), "a whole number");
  return std::nullopt;
}

std::optional<bool> JsonFields::Flag(const char* key) {
  const Json* const value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (value->is_boolean()) return value->get<bool>();
  AddFault(key, FoundText(*value), "true or false");
  return std::nullopt;
}

std::optional<std::vector<double>> JsonFields::Numbers(const char* key, size_t size,
                                                       double factor) {
  const Json* const value = Find(key);
  if (value == nullptr) return std::nullopt;
  const std::string expected = size == 0 ? "a list of numbers" : absl::StrCat(size, " numbers");
  std::vector<double> numbers;
  bool sound = value->is_array() && (size == 0 || value->size() == size);
  for (size_t i = 0; sound && i < value->size(); ++i) {
    sound = (*value)[i].is_number();
    if (sound) numbers.push_back((*value)[i].get<double>() * factor);
  }
  if (sound) return numbers;
  AddFault(key, FoundText(*value), expected);
  return std::nullopt;
}

std::optional<std::vector<std::string>> JsonFields::Texts(const char* key) {
  const Json* const value = Find(key);
  if (value == nullptr) return std::nullopt;
  std::vector<std::string> texts;
  bool sound = value->is_array();
  for (size_t i = 0; sound && i < value->size(); ++i) {
    sound = (*value)[i].is_string();
    if (sound) texts.push_back((*value)[i].get<std::string>());
  }
  if (sound) return texts;
  AddFault(key, FoundText(*value), "a list of texts");
  return std::nullopt;
}

void JsonFields::RefuseOthers() {
  for (const auto& item : object_.items()) {
    if (asked_.count(item.key()) > 0) continue;
    faults_.Add(item.key(), "a key that is not known", "one of " + absl::StrJoin(asked_, ", "));
  }
}

}  // namespace truepose::agent
