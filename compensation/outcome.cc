#include "compensation/outcome.h"

namespace truepose::compensation {

const char* Name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kOk:
      return "ok";
    case Outcome::kNearSingular:
      return "near_singular";
    case Outcome::kBeyondLimit:
      return "beyond_limit";
    case Outcome::kUnreachable:
      return "unreachable";
    case Outcome::kOutsideDomain:
      return "outside_domain";
    case Outcome::kInvalidArgument:
      break;
  }
  return "invalid_argument";
}

}  // namespace truepose::compensation
