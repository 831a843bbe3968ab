// The identification problem: X_MT = X_MB * X_BF(q, lambda) * X_FT against readings.
//
// Candidate parameters, in this order: six corrections of X_MB for each placement, six of X_FT for
// each target (measurement/frame.h), the unknown constants of distances, then the model's internal
// parameters. B stands on the axis of
// joint 1 and F on the last one by construction of the model, so what can't be told from a motion
// of base or tool is found dependent on them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/measurement/frame.h"
#include "core/measurement/reading.h"
#include "core/models/model.h"

namespace truepose {

// What is being found. Frames are poses that corrections are relative to.
struct Estimate {
  std::vector<Pose> X_MB;                        // a placement each
  std::vector<Pose> X_FT;                        // a target each
  Eigen::VectorXd lambda;                        // internal parameters, m or rad
  Eigen::VectorXd offsets = Eigen::VectorXd(0);  // unknown constants of distances, m
};

// What is known of the internal parameters before the readings: root (lambda - mean) has unit
// covariance. A further set of measured values, as weighty as its standard deviations say.
struct Prior {
  Eigen::VectorXd mean;  // the model's parameters
  Eigen::MatrixXd root;  // k x the model's parameters
};

struct Problem {
  const Model* model = nullptr;  // of extent kInternal; not owned
  std::vector<Reading> readings;
  std::vector<std::string> placements;  // labels, for names; at least one
  std::vector<std::string> targets;
  std::vector<std::string> offsets = {};  // labels of the unknown constants of distances
  std::optional<Prior> prior = {};

  int placement_count() const { return static_cast<int>(placements.size()); }
  int target_count() const { return static_cast<int>(targets.size()); }
  int FirstOfBase(int placement) const { return kFrameParameters * placement; }
  int FirstOfTool(int target) const { return kFrameParameters * (placement_count() + target); }
  int FirstOfOffsets() const { return FirstOfTool(target_count()); }
  int FirstInternal() const { return FirstOfOffsets() + static_cast<int>(offsets.size()); }
  int CandidateCount() const { return FirstInternal() + model->parameters.size(); }
};

// Names, groups and roles of the candidates. A label stands in the name only where there are
// several of its kind.
ParameterSet Candidates(const Problem& problem);

// Nominal internal parameters, frames as given or identity.
Estimate NominalEstimate(const Problem& problem);

// Residual rows of all readings, and those of the prior after them.
int RowsOf(const Problem& problem);
int PriorRowsOf(const Problem& problem);

// Which readings are of one row: folds never separate them.
Units UnitsOf(const Problem& problem);

// The candidates that are not internal.
std::vector<int> ExternalCandidates(const Problem& problem);

}  // namespace truepose
