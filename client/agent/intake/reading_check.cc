#include "client/agent/intake/reading_check.h"

#include "absl/strings/str_cat.h"
#include "client/agent/intake/utf8.h"
#include "convert/rules/reading_rules.h"

namespace truepose::agent {

void CheckReading(const v1::Reading& reading, int joints, const std::string& field,
                  FaultList* faults) {
  convert::CheckReading(reading, joints, field, faults);
  if (reading.joints_measured().empty() && reading.joints_commanded().empty())
    faults->Add(field, "no joints", absl::StrCat(joints, " joints, measured or commanded"));
  CheckText(reading, field, faults);
  if (static_cast<int64_t>(reading.ByteSizeLong()) > kLargestReading)
    faults->Add(field, absl::StrCat(reading.ByteSizeLong(), " bytes"),
                absl::StrCat("at most ", kLargestReading));
}

}  // namespace truepose::agent
