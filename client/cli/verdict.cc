#include "client/cli/verdict.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/cli/outcome.h"
#include "core/base/fault.h"

namespace truepose::cli {

void WarnOfVerdict(const Console& console, const v1::CalibrationReport& report) {
  if (report.verdict() != "apply_within_volume") return;
  const std::string reasons = absl::StrJoin(report.verdict_reasons(), "; ");
  Warn(console, absl::StrCat("the calibration's verdict is apply within volume: right where it was "
                             "measured, not shown elsewhere",
                             reasons.empty() ? "" : " (" + reasons + ")"));
}

absl::Status AsFaultOfVerdict(const absl::Status& status) {
  for (const Fault& fault : FaultsOf(status))
    if (absl::StrContains(fault.found, "do_not_apply")) return AsInputFault(status);
  return status;
}

}  // namespace truepose::cli
