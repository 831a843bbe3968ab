// Repeatability from readings that were taken again.
#pragma once

#include <vector>

#include "convert/readings.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

// Fills report.repeatability from readings with equal, not empty values of the column `group` whose
// joints agree within 0.5 deg and 5 mm: the same place again. Points are those measured; of
// contacts, whose place is given, those that the nominal robot says it reached (the chapter's two
// operators). Without such readings the field stays absent.
void FillRepeatability(const std::vector<const v1::SessionInput*>& sessions,
                       const ReadingsProblem& readings, const CalibrationResult& result,
                       v1::CalibrationReport* report);

}  // namespace truepose::convert
