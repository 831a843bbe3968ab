// A JSON object read key by key; what is wrong goes into a FaultList.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/fault.h"
#include "nlohmann/json.hpp"

namespace truepose::agent {

using Json = nlohmann::ordered_json;

class JsonFields {
 public:
  JsonFields(const Json& object, FaultList& faults) : object_(object), faults_(faults) {}

  // A key that is not there, or null, gives none.
  std::optional<std::string> Text(const char* key);
  std::optional<double> Number(const char* key);
  std::optional<int64_t> Whole(const char* key);
  std::optional<bool> Flag(const char* key);
  // Numbers times `factor`; `size` of them unless it is 0.
  std::optional<std::vector<double>> Numbers(const char* key, size_t size, double factor = 1);
  std::optional<std::vector<std::string>> Texts(const char* key);
  const Json& object() const { return object_; }
  bool Has(const char* key) const { return object_.contains(key); }
  // Of which nothing is asked.
  void Ignore(const char* key) { asked_.insert(key); }
  void AddFault(const char* key, std::string found, std::string expected);
  // A fault for each key that nobody asked for.
  void RefuseOthers();

 private:
  const Json* Find(const char* key);

  const Json& object_;
  FaultList& faults_;
  std::set<std::string> asked_;
};

// Whether lists and objects stand in one another more than `most` deep. Such a line is not parsed:
// what handles values calls itself for each level.
bool IsDeeperThan(const std::string& line, int most);

// For a fault: the value as JSON, cut.
std::string FoundText(const Json& value);

}  // namespace truepose::agent
