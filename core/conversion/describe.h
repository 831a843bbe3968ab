// A model of a robot without any reading: what `truepose model` shows.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "core/conversion/counts.h"
#include "core/models/model.h"

namespace truepose {

struct ModelDescription {
  Model model;              // of extent kInternal
  ParameterSet candidates;  // base, tool, internal, as a calibration has them (problem.h)
  IdentifiableSet generic;  // of full poses of one target at one placement, at generic poses; all
                            // redundancies are structural
  ParameterCounts counts;
};

// @param kind one of ModelKinds(). @returns the faults of BuildModel.
absl::StatusOr<ModelDescription> DescribeModel(const std::string& kind, const Robot& robot);

// The link that a model's parameter belongs to, by the number that its name ends in: 3 of "dalpha3"
// and "harmonic1_cos3", none of "base.rx". Link i lies between joint i and joint i+1; 0 is the
// base, the last one carries the flange. Of an effect it is the joint.
std::optional<int> LinkOf(const std::string& name);

}  // namespace truepose
