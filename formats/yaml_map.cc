#include "formats/yaml_map.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "formats/number.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

using Kind = YamlNode::Kind;

// `lower`, `lower_in` for the stem `lower`.
bool IsStemWithoutUnit(std::string_view key, std::string_view stem) {
  if (!ConsumePrefix(&key, stem)) return false;
  return key.empty() || (ConsumePrefix(&key, "_") && key.find('_') == std::string_view::npos);
}

}  // namespace

void YamlFaults::Add(int line, std::string_view path, std::string found,
                     std::string expected) const {
  const std::string_view separator = path.empty() ? "" : ": ";
  faults.Add(StrCat(file_name, ":", line, separator, path), std::move(found), std::move(expected));
}

std::string FieldPath(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : StrCat(path, ".", key);
}

std::string ItemPath(std::string_view path, size_t index) { return StrCat(path, "[", index, "]"); }

const std::vector<YamlNode>& ListItems(const YamlNode& node, std::string_view path,
                                       const YamlFaults& faults) {
  static const std::vector<YamlNode> none;
  if (node.kind == Kind::kSequence) return node.items;
  faults.Add(node.line, path, Describe(node), "a list");
  return none;
}

std::optional<double> NumberOf(const YamlNode& node, std::string_view path,
                               const YamlFaults& faults) {
  const auto number = node.kind == Kind::kScalar ? ParseNumber(node.text) : std::nullopt;
  if (!number.has_value()) faults.Add(node.line, path, Describe(node), "a number");
  return number;
}

std::vector<double> NumbersOf(const YamlNode& node, std::string_view path, int n,
                              std::string_view why, const YamlFaults& faults) {
  std::vector<double> numbers;
  const std::vector<YamlNode>& items = ListItems(node, path, faults);
  for (size_t i = 0; i < items.size(); ++i) {
    if (const auto number = NumberOf(items[i], ItemPath(path, i), faults))
      numbers.push_back(*number);
  }
  if (node.kind == Kind::kSequence && static_cast<int>(items.size()) != n) {
    faults.Add(node.line, path, StrCat(items.size(), " numbers"), StrCat(n, ", ", why));
  }
  return numbers;
}

YamlMap::YamlMap(const YamlNode& node, std::string path, const YamlFaults& faults)
    : node_(node), path_(std::move(path)), faults_(faults) {
  if (is_map()) {
    CheckRepeats();
  } else {
    faults_.Add(node_.line, path_, Describe(node_), "a map of `key: value`");
  }
}

const YamlNode* YamlMap::Find(std::string_view key) {
  if (!IsKnown(key)) known_.emplace_back(key);
  return Lookup(key);
}

const YamlNode* YamlMap::FindRequired(std::string_view key) {
  const YamlNode* found = Find(key);
  if (found == nullptr && is_map()) {
    faults_.Add(node_.line, FieldPath(path_, key), "no such key", "one");
  }
  return found;
}

std::optional<std::string> YamlMap::FindText(std::string_view key) {
  const YamlNode* found = Find(key);
  if (found == nullptr) return std::nullopt;
  if (found->kind == Kind::kScalar && !found->text.empty()) return found->text;
  AddFault(key, Describe(*found), "a text");
  return std::nullopt;
}

std::optional<std::string> YamlMap::FindRequiredText(std::string_view key) {
  return FindRequired(key) == nullptr ? std::nullopt : FindText(key);
}

std::optional<YamlNumber> YamlMap::FindNumber(std::string_view key) {
  const YamlNode* found = Find(key);
  if (found == nullptr) return std::nullopt;
  const auto number = NumberOf(*found, FieldPath(path_, key), faults_);
  if (!number.has_value()) return std::nullopt;
  return YamlNumber{*number, found->line};
}

std::optional<YamlNumber> YamlMap::FindMeasure(std::string_view stem, Dimension dimension) {
  const Unit* unit = nullptr;
  const YamlNode* found = FindWithUnit(stem, dimension, &unit);
  if (found == nullptr) return std::nullopt;
  const auto number = NumberOf(*found, FieldPath(path_, found->key), faults_);
  if (!number.has_value()) return std::nullopt;
  return YamlNumber{unit->to_si(*number), found->line};
}

std::optional<YamlNumber> YamlMap::FindRequiredMeasure(std::string_view stem, Dimension dimension) {
  const size_t before = faults_.faults.faults().size();
  const auto found = FindMeasure(stem, dimension);
  if (found.has_value() || !is_map() || faults_.faults.faults().size() > before) return found;
  const std::vector<std::string> names = NamesWithUnits(stem, dimension);
  faults_.Add(node_.line, FieldPath(path_, names[0]), "no such key", AnyOf(names));
  return std::nullopt;
}

const YamlNode* YamlMap::FindWithUnit(std::string_view stem, Dimension dimension,
                                      const Unit** unit) {
  const YamlNode* found = nullptr;
  for (const std::string& name : NamesWithUnits(stem, dimension)) {
    const YamlNode* node = Find(name);
    if (node == nullptr) continue;
    if (found != nullptr) {
      AddFault(name, StrCat("a second value beside ", found->key), "one of them");
      continue;
    }
    found = node;
    *unit = FindUnit(dimension, std::string_view(name).substr(stem.size() + 1));
  }
  return HasSlip(stem, dimension) ? nullptr : found;
}

void YamlMap::CheckKeys() const {
  for (const YamlNode& item : node_.items) {
    if (!is_map() || IsKnown(item.key)) continue;
    const std::string nearest = Nearest(item.key, known_);
    faults_.Add(item.line, FieldPath(path_, Quoted(item.key)), "an unknown key",
                nearest.empty() ? AnyOf(known_) : nearest);
  }
}

void YamlMap::AddFault(std::string_view key, std::string found, std::string expected) const {
  const YamlNode* node = Lookup(key);
  faults_.Add(node == nullptr ? node_.line : node->line, FieldPath(path_, key), std::move(found),
              std::move(expected));
}

const YamlNode* YamlMap::Lookup(std::string_view key) const {
  if (!is_map()) return nullptr;
  const auto it = std::find_if(node_.items.begin(), node_.items.end(),
                               [&](const YamlNode& item) { return item.key == key; });
  return it == node_.items.end() ? nullptr : &*it;
}

bool YamlMap::IsKnown(std::string_view key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

bool YamlMap::HasSlip(std::string_view stem, Dimension dimension) {
  bool slip = false;
  for (const YamlNode& item : node_.items) {
    if (!is_map() || IsKnown(item.key) || !IsStemWithoutUnit(item.key, stem)) continue;
    AddFault(item.key, StrCat("the key ", Quoted(item.key)),
             AnyOf(NamesWithUnits(stem, dimension)));
    known_.push_back(item.key);
    slip = true;
  }
  return slip;
}

void YamlMap::CheckRepeats() const {
  std::unordered_set<std::string_view> keys;
  for (const YamlNode& item : node_.items) {
    if (keys.insert(item.key).second) continue;
    faults_.Add(item.line, FieldPath(path_, Quoted(item.key)), "the key a second time", "one");
  }
}

}  // namespace truepose::formats
