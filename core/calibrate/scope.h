// Which part of a calibration is to be found anew.
//
//   all, internal      everything; base and tool are found with the internal parameters, since the
//                      instrument stands somewhere and the target sits somehow
//   external           base and tool, internal parameters as they are
//   base, tool         one of them; the other must be known
//   joint_offsets      base, tool and every dq
//   NAME,NAME...       base, tool and these parameters; the words above may stand among them
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/identification/problem.h"

namespace truepose {

struct Scope {
  std::vector<int> free;   // candidates, ascending; empty = all
  std::vector<int> named;  // of these, those that were asked for by their own name
  bool base = true, tool = true;
};

// @param text as above; "" is all.
// @returns kInvalidArgument with a fault of `options.calibrate` for each name that is neither a
// word nor an internal candidate, also beside words that free everything; for a list of nothing.
absl::StatusOr<Scope> ScopeOf(const std::string& text, const Problem& problem);

// The faults that ScopeOf finds, as far as the model alone shows them.
absl::Status CheckScope(const std::string& text, const Model& model);

// Whether the text, without any problem, is one that frees a part only.
bool IsPartial(const std::string& text);

}  // namespace truepose
