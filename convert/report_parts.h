// Parts of a calibration's report beside sets and parameters.
#pragma once

#include <string>

#include "convert/readings.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

// What a value in SI is multiplied by for people, and what it is then in.
double ScaleOf(Unit unit);
std::string NameOf(Unit unit);

// @param generic_rank of readings of this sort at any poses, @param rank of these; both with
// effects.
v1::ParameterCounts CountsOf(const ParameterCounts& counts, int generic_rank, int rank);
v1::Redundancy RedundancyOf(const NullRelation& relation, const ParameterSet& candidates);

// Counts, selection, effects, suspects, correlations, predicted accuracy, places of fixtures, the
// test of a change.
void FillFindings(const CalibrationResult& result, const ReadingsProblem& readings,
                  v1::CalibrationReport* report);

}  // namespace truepose::convert
