// YAML as a tree of plain values with their lines: the only place that knows the YAML library.
//
// One document without aliases, with scalars as keys. That is all a robot file needs, and without
// aliases a small file can't unfold into a large tree.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"

namespace truepose::formats {

struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;
  int line = 1;                 // counted from 1; of its key when it stands in a map
  std::string key;              // of the entry, when it stands in a map
  std::string text;             // of a scalar
  std::vector<YamlNode> items;  // of a sequence or a map, in the order of the file; keys may repeat
};

// Adds faults as `file_name:line` for what is no YAML, is no UTF-8 or is not in the subset above;
// the tree is then null.
YamlNode ParseYaml(std::string_view text, std::string_view file_name, FaultList& faults);

// "'text'", "a list of 3", "a map", "nothing": what a fault says that it found.
std::string Describe(const YamlNode& node);

// `text` so that YAML reads it back as the same text: plain when it is a simple word, else in
// double quotes.
std::string YamlText(std::string_view text);

}  // namespace truepose::formats
