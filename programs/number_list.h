// Lists of plain numbers in square brackets, nested as the text has them.
#pragma once

#include <optional>
#include <vector>

#include "programs/words.h"

namespace truepose::programs {

// Either a number or a list.
struct NumberNode {
  std::optional<JointNumber> number;
  std::vector<NumberNode> items;
  int line = 0;

  bool IsNumber() const { return number.has_value(); }
  // Whether it is a list of at least one number and of nothing else.
  bool IsFlat() const;
  std::vector<JointNumber> Numbers() const;  // of a flat list
};

// Reads the list that begins at `*i` and moves `*i` behind it. Line ends between items are blanks.
// nullopt, and `*i` as it was, for anything that is not plain numbers, such as names, arithmetic or
// more than five levels of lists.
// @param degrees_function takes d2r(number) for a number as well.
std::optional<NumberNode> ReadNumberList(const Words& words, size_t* i, Unit unit,
                                         bool degrees_function);

}  // namespace truepose::programs
