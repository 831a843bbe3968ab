// One table of a TOML file, read key by key; what is wrong goes into a FaultList with its line.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"
#include "toml++/toml.h"

namespace truepose::agent {

class TomlTable {
 public:
  // @param file for faults; `prefix` such as "robot[1]."
  TomlTable(const toml::table& table, std::string file, std::string prefix, FaultList& faults)
      : table_(table), file_(std::move(file)), prefix_(std::move(prefix)), faults_(faults) {}

  // A key that is not there leaves `out` as it is.
  void Text(const char* key, std::string* out);
  void Number(const char* key, int64_t least, int64_t most, int64_t* out);
  void Flag(const char* key, bool* out);
  void Texts(const char* key, std::vector<std::string>* out);
  // The tables of an array of tables.
  std::vector<TomlTable> Tables(const char* key);
  // Faults for keys that must be there.
  void Require(const std::vector<const char*>& keys);
  // A fault for each key that nobody asked for.
  void RefuseOthers();
  // Keys that nobody asked for, as text; arrays and tables are faults.
  std::vector<std::pair<std::string, std::string>> Others();

  void AddFault(const std::string& key, std::string found, std::string expected);
  // "agent.toml:12: robot[1].joints"
  std::string Place(const std::string& key) const;

 private:
  const toml::node* Find(const char* key);
  static std::string TextOf(const toml::node& node);

  const toml::table& table_;
  const std::string file_, prefix_;
  FaultList& faults_;
  std::set<std::string> asked_;
};

}  // namespace truepose::agent
