#include "programs/program.h"

#include <algorithm>

#include "programs/krl.h"
#include "programs/rapid.h"
#include "programs/urscript.h"

namespace truepose::programs {

size_t JointTarget::begin() const {
  size_t first = std::string::npos;
  for (const JointNumber& number : joints) first = std::min(first, number.begin);
  return first;
}

Program ReadProgram(std::string_view text, Dialect dialect, int joints) {
  switch (dialect) {
    case Dialect::kUrScript:
      return ReadUrScript(text);
    case Dialect::kKrl:
      return ReadKrl(text, joints);
    case Dialect::kRapid:
      return ReadRapid(text);
  }
  return {};
}

}  // namespace truepose::programs
