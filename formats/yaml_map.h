// One map of a YAML tree, read field by field; gathers every fault with file, line and path.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"
#include "formats/unit.h"
#include "formats/yaml.h"

namespace truepose::formats {

// Where faults go, and the name that stands before their line.
struct YamlFaults {
  std::string_view file_name;
  FaultList& faults;

  // "ur10.yaml:23: joints[2].lower_deg"
  void Add(int line, std::string_view path, std::string found, std::string expected) const;
};

// "geometry" and "flange" -> "geometry.flange"; "" and "joints" -> "joints".
std::string FieldPath(std::string_view path, std::string_view key);
// "joints" and 2 -> "joints[2]".
std::string ItemPath(std::string_view path, size_t index);

// The items of a list; a fault and none when the node is no list.
const std::vector<YamlNode>& ListItems(const YamlNode& node, std::string_view path,
                                       const YamlFaults& faults);

// A number of any node; a fault and nullopt when it is none.
std::optional<double> NumberOf(const YamlNode& node, std::string_view path,
                               const YamlFaults& faults);

// `n` numbers of a list; fewer, with a fault, when there is another count or one is none. @param
// why n: "as many as joints".
std::vector<double> NumbersOf(const YamlNode& node, std::string_view path, int n,
                              std::string_view why, const YamlFaults& faults);

struct YamlNumber {
  double value = 0;
  int line = 0;
};

// Every Find... makes its key a known one; CheckKeys() at the end names the others.
class YamlMap {
 public:
  // A node that is no map, or a key that stands twice, is a fault; the map is then empty, or keeps
  // the first. All arguments have to outlive the map.
  YamlMap(const YamlNode& node, std::string path, const YamlFaults& faults);

  const YamlNode* Find(std::string_view key);
  const YamlNode* FindRequired(std::string_view key);

  // A text that is not empty; a fault when there is something else.
  std::optional<std::string> FindText(std::string_view key);
  std::optional<std::string> FindRequiredText(std::string_view key);
  std::optional<YamlNumber> FindNumber(std::string_view key);

  // A length or an angle in SI units, from the key `stem_unit`. A missing, unknown or second unit
  // is a fault.
  std::optional<YamlNumber> FindMeasure(std::string_view stem, Dimension dimension);
  std::optional<YamlNumber> FindRequiredMeasure(std::string_view stem, Dimension dimension);

  // The node of a key `stem_unit` whatever it holds, with the unit; nullptr when there is none.
  // Faults as above.
  const YamlNode* FindWithUnit(std::string_view stem, Dimension dimension, const Unit** unit);

  // A fault for each key that nothing asked for, with the nearest known one.
  void CheckKeys() const;

  void AddFault(std::string_view key, std::string found, std::string expected) const;

  bool is_map() const { return node_.kind == YamlNode::Kind::kMap; }
  const YamlNode& node() const { return node_; }
  const std::string& path() const { return path_; }
  const YamlFaults& faults() const { return faults_; }

 private:
  const YamlNode* Lookup(std::string_view key) const;
  bool IsKnown(std::string_view key) const;
  bool HasSlip(std::string_view stem, Dimension dimension);
  void CheckRepeats() const;

  const YamlNode& node_;
  std::string path_;
  const YamlFaults& faults_;
  std::vector<std::string> known_;
};

}  // namespace truepose::formats
