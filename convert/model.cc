#include "convert/robot.h"
#include "convert/run.h"
#include "core/base/status_macros.h"
#include "core/calibrate/scope.h"
#include "core/conversion/describe.h"
#include "core/models/build_model.h"

namespace truepose::convert {
namespace {

v1::ParameterGroup GroupOf(ParameterGroup group) {
  switch (group) {
    case ParameterGroup::kBase:
      return v1::BASE;
    case ParameterGroup::kTool:
      return v1::TOOL;
    case ParameterGroup::kInstrument:
      return v1::INSTRUMENT;
    case ParameterGroup::kInternal:
      break;
  }
  return v1::INTERNAL;
}

v1::ModelParameter ParameterOf(const Parameter& parameter) {
  v1::ModelParameter message;
  message.set_name(parameter.name);
  message.set_group(GroupOf(parameter.group));
  message.set_unit(parameter.is_angle() ? "deg" : "mm");
  return message;
}

v1::ParameterCounts CountsOf(const ParameterCounts& counts) {
  v1::ParameterCounts message;
  message.set_complete(counts.complete_by_formula);
  message.set_measured(counts.measured_by_formula);
  message.set_internal(counts.internal_by_formula);
  message.set_generic_rank(counts.rank);
  return message;
}

v1::Redundancy RedundancyOf(const NullRelation& relation, const ParameterSet& candidates) {
  v1::Redundancy message;
  message.set_dropped(candidates[relation.dropped].name);
  message.set_relation(RelationText(relation, candidates));
  message.set_reason(DroppedText(relation, candidates));
  message.set_structural(relation.structural);
  return message;
}

}  // namespace

absl::StatusOr<v1::ModelDescription> RunModelDescription(const v1::Nominal& nominal,
                                                         const std::string& kind) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const ModelDescription description,
                            DescribeModel(kind.empty() ? "modified_incremental" : kind, robot));
  v1::ModelDescription message;
  message.set_model(description.model.kind);
  message.set_convention(description.model.convention);
  for (const Parameter& parameter : description.candidates)
    *message.add_parameters() = ParameterOf(parameter);
  for (int index : description.generic.active) message.mutable_parameters(index)->set_kept(true);
  *message.mutable_counts() = CountsOf(description.counts);
  for (const NullRelation& relation : description.generic.redundancies)
    *message.add_redundancies() = RedundancyOf(relation, description.candidates);
  return message;
}

absl::Status CheckCalibratedNames(const v1::Nominal& nominal,
                                  const v1::CalibrationOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  const std::string kind = options.model().empty() ? "modified_incremental" : options.model();
  TRUEPOSE_ASSIGN_OR_RETURN(Model model, BuildModel(kind, robot, ModelExtent::kInternal));
  for (const EffectGroup group : AllEffectGroups()) AddEffects(robot, group, &model);
  return CheckScope(options.calibrate(), model);
}

}  // namespace truepose::convert
