#include "client/agent/config/toml_table.h"

#include <sstream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace truepose::agent {

const toml::node* TomlTable::Find(const char* key) {
  asked_.insert(key);
  return table_.get(key);
}

std::string TomlTable::TextOf(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

// A key that is missing has no line of its own: that of its table.
std::string TomlTable::Place(const std::string& key) const {
  const toml::node* const node = table_.get(key);
  const auto line = (node != nullptr ? node->source() : table_.source()).begin.line;
  return absl::StrCat(file_, ":", line, ": ", prefix_, key);
}

void TomlTable::AddFault(const std::string& key, std::string found, std::string expected) {
  faults_.Add(Place(key), std::move(found), std::move(expected));
}

void TomlTable::Text(const char* key, std::string* out) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  if (const auto* text = node->as_string()) {
    *out = text->get();
  } else {
    AddFault(key, TextOf(*node), "text in quotes");
  }
}

void TomlTable::Number(const char* key, int64_t least, int64_t most, int64_t* out) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  const auto* number = node->as_integer();
  if (number != nullptr && number->get() >= least && number->get() <= most) {
    *out = number->get();
  } else {
    AddFault(key, TextOf(*node), absl::StrCat("a whole number from ", least, " to ", most));
  }
}

void TomlTable::Flag(const char* key, bool* out) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  if (const auto* flag = node->as_boolean()) {
    *out = flag->get();
  } else {
    AddFault(key, TextOf(*node), "true or false");
  }
}

void TomlTable::Texts(const char* key, std::vector<std::string>* out) {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  const toml::array* const list = node->as_array();
  if (list == nullptr) return AddFault(key, TextOf(*node), "a list of texts");
  for (const toml::node& entry : *list) {
    if (const auto* text = entry.as_string()) {
      out->push_back(text->get());
    } else {
      AddFault(key, TextOf(entry), "a text in quotes");
    }
  }
}

std::vector<TomlTable> TomlTable::Tables(const char* key) {
  std::vector<TomlTable> tables;
  const toml::node* const node = Find(key);
  if (node == nullptr) return tables;
  const toml::array* const list = node->as_array();
  if (list == nullptr || !list->is_array_of_tables()) {
    AddFault(key, "something else", absl::StrCat("tables [[", key, "]]"));
    return tables;
  }
  for (const toml::node& entry : *list)
    tables.emplace_back(*entry.as_table(), file_,
                        absl::StrCat(prefix_, key, "[", tables.size(), "]."), faults_);
  return tables;
}

void TomlTable::Require(const std::vector<const char*>& keys) {
  for (const char* key : keys)
    if (Find(key) == nullptr) AddFault(key, "nothing", "a value");
}

void TomlTable::RefuseOthers() {
  const std::string known = absl::StrJoin(asked_, ", ");
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (asked_.count(name) == 0) AddFault(name, "a key that is not known", "one of " + known);
  }
}

std::vector<std::pair<std::string, std::string>> TomlTable::Others() {
  std::vector<std::pair<std::string, std::string>> others;
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (asked_.count(name) > 0) continue;
    if (node.is_array() || node.is_table()) {
      AddFault(name, "a list or table", "a text, a number, true or false");
    } else {
      others.emplace_back(name, TextOf(node));
    }
  }
  return others;
}

}  // namespace truepose::agent
