// Faults in the units that a person wrote: the API speaks of m and rad, people of mm and deg.
#pragma once

#include "absl/status/status.h"
#include "formats/message_file.h"

namespace truepose::cli {

// `box.max_x_m: found 0.5 m, expected more than 0.7 m` becomes `box.max_x_mm: found 500 mm,
// expected more than 700 mm`, unless `given` has the field in m; the same of rad and deg. Faults
// with numbers of which the unit isn't said stay as they are, and so do code and hint.
absl::Status InWrittenUnits(const absl::Status& status, const formats::GivenFields& given);

}  // namespace truepose::cli
