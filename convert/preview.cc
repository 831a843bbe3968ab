#include "core/calibrate/preview.h"

#include "convert/prepared_calibration.h"
#include "convert/report_parts.h"
#include "convert/run.h"
#include "core/base/status_macros.h"

namespace truepose::convert {

absl::StatusOr<v1::JobPreview> RunPreview(const v1::CalibrationInput& input,
                                          const RunHooks& hooks) {
  v1::CalibrationInput one = input;
  if (one.options().joints() == "both") one.mutable_options()->set_joints("measured");
  TRUEPOSE_ASSIGN_OR_RETURN(const PreparedCalibration prepared, PrepareCalibration(one));
  const CalibrationProblem& problem = prepared.readings.problem;
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibrationPreview preview,
                            PreviewCalibration(problem, prepared.options, CoreHooks(hooks)));
  v1::JobPreview message;
  *message.mutable_counts() =
      CountsOf(preview.counts, preview.generic_rank, static_cast<int>(preview.set.active.size()));
  for (int index : preview.set.active) message.add_identifiable(preview.candidates[index].name);
  for (const NullRelation& relation : preview.set.redundancies)
    *message.add_redundancies() = RedundancyOf(relation, preview.candidates);
  message.set_readings(static_cast<int>(problem.readings.size()));
  return message;
}

}  // namespace truepose::convert
