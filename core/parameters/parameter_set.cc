#include "core/parameters/parameter_set.h"

#include <cassert>
#include <utility>

namespace truepose {

int ParameterSet::Add(Parameter parameter) {
  const int index = size();
  const bool added = index_.emplace(parameter.name, index).second;
  assert(added);
  (void)added;
  parameters_.push_back(std::move(parameter));
  return index;
}

std::optional<int> ParameterSet::Find(std::string_view name) const {
  const auto it = index_.find(std::string(name));
  if (it == index_.end()) return std::nullopt;
  return it->second;
}

}  // namespace truepose
