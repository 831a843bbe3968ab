// What can be wrong with options, and which joints exceed their limits.
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "convert/options.h"
#include "convert/run.h"
#include "core/assessment/split.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

// Rows in a warning: enough to find them, not so many that they hide the rest.
constexpr size_t kRowsShown = 20;

std::string Rows(const std::vector<int>& rows) {
  const size_t shown = std::min(rows.size(), kRowsShown);
  return absl::StrCat(
      rows.size() == 1 ? "row " : "rows ",
      absl::StrJoin(rows.begin(), rows.begin() + static_cast<long>(shown), ", "),
      rows.size() > shown ? absl::StrCat(" and ", rows.size() - shown, " more") : "");
}

std::string InUnits(double value, v1::JointType type) {
  return type == v1::PRISMATIC ? absl::StrFormat("%.6g mm", value * 1e3)
                               : absl::StrFormat("%.6g deg", value * 180 / 3.14159265358979323846);
}

// The rows in which a joint is beyond a limit, by `exceeds`, of measured joints or, where there are
// none, commanded ones.
template <typename Exceeds>
std::vector<int> RowsBeyond(const std::vector<v1::Reading>& readings, int joint, Exceeds exceeds) {
  std::vector<int> rows;
  for (const v1::Reading& reading : readings) {
    const auto& q =
        reading.joints_measured_size() > 0 ? reading.joints_measured() : reading.joints_commanded();
    if (joint < q.size() && exceeds(q[joint])) rows.push_back(reading.row());
  }
  return rows;
}

}  // namespace

std::vector<std::string> LimitWarnings(const v1::Nominal& nominal,
                                       const std::vector<v1::Reading>& readings) {
  std::vector<std::string> warnings;
  for (int i = 0; i < nominal.joints_size(); ++i) {
    const v1::Joint& joint = nominal.joints(i);
    const auto warn = [&](const char* side, double limit, const std::vector<int>& rows) {
      if (rows.empty()) return;
      warnings.push_back(absl::StrCat("joint ", joint.name(), " is ", side, " its limit of ",
                                      InUnits(limit, joint.type()), " in ", Rows(rows)));
    };
    if (joint.has_lower()) {
      warn("below", joint.lower(),
           RowsBeyond(readings, i, [&](double q) { return q < joint.lower(); }));
    }
    if (joint.has_upper()) {
      warn("above", joint.upper(),
           RowsBeyond(readings, i, [&](double q) { return q > joint.upper(); }));
    }
  }
  return warnings;
}

absl::Status ValidateOptions(const v1::CalibrationOptions& options) {
  FaultList faults;
  faults.AddAll(ParseSplit(options.split()).status());
  faults.AddAll(CalibrateOptionsFrom(options).status());
  if (options.observe() < v1::OBSERVE_UNSPECIFIED || options.observe() > v1::POINT_AXIS) {
    faults.Add("options.observe", absl::StrCat(static_cast<int>(options.observe())),
               "POSE, POINT or POINT_AXIS");
  }
  return faults.ToStatus();
}

}  // namespace truepose::convert
