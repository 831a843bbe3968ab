// The measured UR10 of the shared data, read without the layer of file formats.
#pragma once

#include <string>
#include <vector>

#include "core/measurement/reading.h"

namespace truepose::testing {

// The calibration half of the split even-odd: rows 0, 2, 4 ... of data/ipa_ur10/series_`name`.csv,
// full poses with the stated scatter of the position. @param name "C" or "D".
std::vector<Reading> LoadUr10CalibrationHalf(const std::string& name);

// Where the tracker's target is, nearly.
Pose Ur10Target();

}  // namespace truepose::testing
