#include "core/identification/problem.h"

#include <numeric>

#include "absl/strings/str_cat.h"

namespace truepose {
namespace {

void AddFrames(ParameterGroup group, const std::vector<std::string>& labels, ParameterSet* set) {
  for (const std::string& label : labels) {
    for (int i = 0; i < kFrameParameters; ++i) {
      set->Add(FrameParameter(group, labels.size() > 1 ? label : std::string(), i));
    }
  }
}

}  // namespace

ParameterSet Candidates(const Problem& problem) {
  ParameterSet set;
  AddFrames(ParameterGroup::kBase, problem.placements, &set);
  AddFrames(ParameterGroup::kTool, problem.targets, &set);
  for (const std::string& label : problem.offsets) {
    set.Add({absl::StrCat("offset[", label, "]"), ParameterGroup::kInstrument,
             ParameterRole::kExternal, Unit::kMetre});
  }
  for (const Parameter& parameter : problem.model->parameters) set.Add(parameter);
  return set;
}

Estimate NominalEstimate(const Problem& problem) {
  return {std::vector<Pose>(problem.placements.size()), std::vector<Pose>(problem.targets.size()),
          Eigen::VectorXd::Zero(problem.model->parameters.size()),
          Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.offsets.size()))};
}

int RowsOf(const Problem& problem) {
  int rows = 0;
  for (const Reading& reading : problem.readings) rows += RowsOf(reading);
  return rows;
}

int PriorRowsOf(const Problem& problem) {
  return problem.prior ? static_cast<int>(problem.prior->root.rows()) : 0;
}

Units UnitsOf(const Problem& problem) {
  std::vector<int> rows;
  for (const Reading& reading : problem.readings) rows.push_back(reading.row);
  return UnitsOfRows(rows);
}

std::vector<int> ExternalCandidates(const Problem& problem) {
  std::vector<int> external(problem.FirstInternal());
  std::iota(external.begin(), external.end(), 0);
  return external;
}

}  // namespace truepose
