#include "convert/report_parts.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/report.h"

namespace truepose::convert {
namespace {

v1::SelectionStep StepOf(const std::string& added, int parameters, double weighted_rms,
                         double criterion, bool taken) {
  v1::SelectionStep step;
  step.set_added(added);
  step.set_parameters(parameters);
  step.set_weighted_rms(weighted_rms);
  step.set_criterion(criterion);
  step.set_taken(taken);
  return step;
}

// One sentence for all groups that were not tried, each with its reason.
void WarnOfUntried(const CalibrationResult& result, const ReadingsProblem& readings,
                   v1::CalibrationReport* report) {
  std::vector<std::string> texts;
  for (const UntriedEffect& untried : result.effects.untried) {
    std::string text = absl::StrCat(Name(untried.group), " (", untried.reason);
    if (untried.reading_id >= 0)
      absl::StrAppend(&text, "; first in row ", readings.rows[untried.reading_id].row);
    texts.push_back(text + ")");
  }
  if (!texts.empty())
    report->add_warnings(absl::StrCat("effects not tried: ", absl::StrJoin(texts, ", ")));
}

void FillSelection(const CalibrationResult& result, v1::CalibrationReport* report) {
  for (const SelectionStep& step : result.selection)
    *report->add_selection() =
        StepOf(step.added, step.parameters, step.weighted_rms, step.criterion, step.taken);
  for (const EffectStep& step : result.effects.path)
    *report->add_selection() =
        StepOf(step.added, step.parameters, step.weighted_rms, step.cross_validated, step.taken);
  for (EffectGroup group : result.effect_groups) report->add_effects(Name(group));
}

void FillSuspects(const CalibrationResult& result, const ReadingsProblem& readings,
                  v1::CalibrationReport* report) {
  for (const Suspect& suspect : result.suspects) {
    const RowOf& row = readings.rows[readings.problem.readings[suspect.reading].id];
    v1::Suspect* message = report->add_suspects();
    message->set_session(row.session);
    message->set_row(row.row);
    message->set_weight(suspect.weight);
    message->set_reason(suspect.reason);
  }
}

void FillCorrelations(const CalibrationResult& result, v1::CalibrationReport* report) {
  for (const Correlation& correlation : result.correlations) {
    v1::Correlation* message = report->add_correlations();
    message->set_a(result.candidates[correlation.a].name);
    message->set_b(result.candidates[correlation.b].name);
    message->set_value(correlation.value);
  }
}

void FillPredicted(const CalibrationResult& result, v1::CalibrationReport* report) {
  const PredictedAccuracy& predicted = result.predicted;
  if (predicted.control == 0) return;
  v1::PredictedAccuracy* message = report->mutable_predicted();
  message->set_position_rms_mm(predicted.position_rms_m * kMmPerM);
  message->set_control(predicted.control);
  message->set_inside(predicted.inside);
  message->set_inside_covariance_alone(predicted.inside_covariance_alone);
}

void FillPlaces(const CalibrationResult& result, const ReadingsProblem& readings,
                v1::CalibrationReport* report) {
  if (result.control_places.errors.empty()) return;
  const SetResult places{result.control_places.errors, result.control_places.errors};
  *report->mutable_control_places() = SetReportOf(places, readings.rows);
  report->mutable_control_places()->clear_before();
  report->set_largest_spacing_error_mm(result.control_places.largest_spacing_error_m * kMmPerM);
}

void FillChange(const CalibrationResult& result, v1::CalibrationReport* report) {
  if (!result.change) return;
  v1::ChangeTest* change = report->mutable_change();
  for (const std::string& name : result.change->names) change->add_names(name);
  change->set_chi_square(result.change->chi_square);
  change->set_degrees_of_freedom(result.change->degrees_of_freedom);
  change->set_p_value(result.change->p_value);
  change->set_real(result.change->real);
}

}  // namespace

double ScaleOf(Unit unit) {
  switch (unit) {
    case Unit::kMetre:
    case Unit::kMetrePerNewton:
    case Unit::kMetrePerKelvin:
      return kMmPerM;
    case Unit::kRadian:
    case Unit::kRadianPerNewtonMetre:
    case Unit::kRadianPerKelvin:
      return kDegPerRad;
    case Unit::kRatio:
      break;
  }
  return 1;
}

std::string NameOf(Unit unit) {
  switch (unit) {
    case Unit::kMetre:
      return "mm";
    case Unit::kRadian:
      return "deg";
    case Unit::kRadianPerNewtonMetre:
      return "deg/(N m)";
    case Unit::kMetrePerNewton:
      return "mm/N";
    case Unit::kRadianPerKelvin:
      return "deg/K";
    case Unit::kMetrePerKelvin:
      return "mm/K";
    case Unit::kRatio:
      break;
  }
  return "1";
}

v1::ParameterCounts CountsOf(const ParameterCounts& counts, int generic_rank, int rank) {
  v1::ParameterCounts message;
  message.set_complete(counts.complete_by_formula);
  message.set_measured(counts.measured_by_formula);
  message.set_internal(counts.internal_by_formula);
  message.set_generic_rank(generic_rank);
  message.set_rank(rank);
  return message;
}

v1::Redundancy RedundancyOf(const NullRelation& relation, const ParameterSet& candidates) {
  v1::Redundancy message;
  message.set_dropped(candidates[relation.dropped].name);
  message.set_relation(RelationText(relation, candidates));
  message.set_reason(ReasonText(relation, candidates));
  message.set_structural(relation.structural);
  return message;
}

void FillFindings(const CalibrationResult& result, const ReadingsProblem& readings,
                  v1::CalibrationReport* report) {
  *report->mutable_counts() = CountsOf(result.counts, result.generic_rank,
                                       static_cast<int>(result.identification.set.active.size()));
  FillSelection(result, report);
  WarnOfUntried(result, readings, report);
  FillSuspects(result, readings, report);
  FillCorrelations(result, report);
  FillPredicted(result, report);
  FillPlaces(result, readings, report);
  FillChange(result, report);
  report->set_covariance_approximate(result.identification.summary.covariance_approximate);
}

}  // namespace truepose::convert
