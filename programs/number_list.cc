#include "programs/number_list.h"

#include <algorithm>

namespace truepose::programs {
namespace {

constexpr int kDeepest = 5;

class ListReader {
 public:
  ListReader(const Words& words, Unit unit, bool degrees_function)
      : words_(words), unit_(unit), degrees_function_(degrees_function) {}

  // @returns false when the text there is no such list; `node` is then unspecified.
  bool ReadList(size_t* i, int depth, NumberNode* node) const {
    if (depth > kDeepest || !words_.IsSign(*i, "[")) return false;
    node->line = words_.Line(*i);
    do {
      *i = words_.SkipLineEnds(*i + 1);
      if (!ReadItem(i, depth, &node->items.emplace_back())) return false;
      *i = words_.SkipLineEnds(*i);
    } while (words_.IsSign(*i, ","));
    return words_.IsSign((*i)++, "]");
  }

 private:
  bool ReadItem(size_t* i, int depth, NumberNode* node) const {
    if (words_.IsSign(*i, "[")) return ReadList(i, depth + 1, node);
    node->line = words_.Line(*i);
    node->number = degrees_function_ && words_.Text(*i) == "d2r" ? ReadDegrees(i)
                                                                 : words_.ReadNumber(i, unit_);
    return node->IsNumber();
  }

  std::optional<JointNumber> ReadDegrees(size_t* i) const {
    if (!words_.IsSign(++*i, "(")) return std::nullopt;
    ++*i;
    const std::optional<JointNumber> number = words_.ReadNumber(i, Unit::kDegreesFunction);
    return words_.IsSign((*i)++, ")") ? number : std::nullopt;
  }

  const Words& words_;
  const Unit unit_;
  const bool degrees_function_;
};

}  // namespace

bool NumberNode::IsFlat() const {
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), [](const auto& item) { return item.IsNumber(); });
}

std::vector<JointNumber> NumberNode::Numbers() const {
  std::vector<JointNumber> numbers;
  for (const NumberNode& item : items) numbers.push_back(*item.number);
  return numbers;
}

std::optional<NumberNode> ReadNumberList(const Words& words, size_t* i, Unit unit,
                                         bool degrees_function) {
  NumberNode node;
  size_t next = *i;
  if (!ListReader(words, unit, degrees_function).ReadList(&next, 1, &node)) return std::nullopt;
  *i = next;
  return node;
}

}  // namespace truepose::programs
