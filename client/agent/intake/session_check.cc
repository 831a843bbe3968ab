#include "client/agent/intake/session_check.h"

#include <cmath>
#include <string_view>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "client/agent/intake/utf8.h"

namespace truepose::agent {
namespace {

// As server/resource: [a-z0-9][a-z0-9-]{0,62}.
bool IsId(std::string_view id) {
  if (id.empty() || id.size() > 63 || id.front() == '-') return false;
  for (const char c : id)
    if (!absl::ascii_islower(c) && !absl::ascii_isdigit(c) && c != '-') return false;
  return true;
}

void CheckName(const std::string& name, const std::string& prefix, const char* field,
               FaultList* faults) {
  if (name.empty()) return;
  if (std::string_view(name).starts_with(prefix) &&
      IsId(std::string_view(name).substr(prefix.size())))
    return;
  faults->Add(field, absl::StrCat("'", name, "'"),
              absl::StrCat(prefix, "{id} of lower-case letters, digits and -"));
}

}  // namespace

bool IsUuid(const std::string& text) {
  if (text.size() != 36) return false;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-'
             : !(absl::ascii_isdigit(text[i]) || (text[i] >= 'a' && text[i] <= 'f')))
      return false;
  }
  return true;
}

absl::Status CheckSession(const v1::Session& content) {
  FaultList faults;
  CheckName(content.instrument(), "instruments/", "instrument", &faults);
  CheckName(content.fixture(), "fixtures/", "fixture", &faults);
  CheckName(content.placement(), content.robot() + "/placements/", "placement", &faults);
  if (content.has_temperature_c() && !std::isfinite(content.temperature_c()))
    faults.Add("temperature_c", absl::StrCat(content.temperature_c()), "a finite number");
  if (content.has_load_kg() && !(content.load_kg() >= 0 && std::isfinite(content.load_kg())))
    faults.Add("load_kg", absl::StrCat(content.load_kg()), "0 or more");
  if (content.purpose() < v1::SESSION_PURPOSE_UNSPECIFIED || content.purpose() > v1::CHECK)
    faults.Add("purpose", absl::StrCat(content.purpose()), "CALIBRATION or CHECK");
  CheckText(content, "session", &faults);
  return faults.ToStatus();
}

}  // namespace truepose::agent
