#include "client/cli/verdict.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace truepose::cli {

void WarnOfVerdict(const Console& console, const v1::CalibrationReport& report) {
  if (report.verdict() != "apply_within_volume") return;
  const std::string reasons = absl::StrJoin(report.verdict_reasons(), "; ");
  Warn(console, absl::StrCat("the calibration's verdict is apply within volume: right where it was "
                             "measured, not shown elsewhere",
                             reasons.empty() ? "" : " (" + reasons + ")"));
}

}  // namespace truepose::cli
