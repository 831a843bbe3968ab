// Repeatability from readings that were taken again.
#pragma once

#include <vector>

#include "convert/readings.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

// Fills report.repeatability from readings with equal, not empty values of the column `group`.
// Visits of a group (and placement and target) whose joints agree within 0.5 deg and 5 mm, or that
// such visits connect, are one place: its points are those of ISO 9283, each two of them a pair of
// the chapter. Visits that no other of their group meets are left out, and a warning counts them.
// Neither depends on the order of the rows. Points are those measured; of contacts, whose place is
// given, those that the nominal robot says it reached (the chapter's two operators). Without two
// visits of a place the field stays absent.
void FillRepeatability(const std::vector<const v1::SessionInput*>& sessions,
                       const ReadingsProblem& readings, const CalibrationResult& result,
                       v1::CalibrationReport* report);

}  // namespace truepose::convert
