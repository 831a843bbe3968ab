#include <algorithm>

#include "absl/strings/str_format.h"
#include "formats/csv.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/targets_file.h"

namespace truepose::formats {
namespace {

std::vector<std::string> ResultHeader(const v1::Nominal& nominal, bool joints, bool pose) {
  std::vector<std::string> header = {"row"};
  for (int i = 0; joints && i < nominal.joints_size(); ++i) {
    const bool prismatic = nominal.joints(i).type() == v1::PRISMATIC;
    header.push_back(StrCat("q", i + 1, prismatic ? "_m" : "_rad"));
  }
  if (pose) header.insert(header.end(), {"x_mm", "y_mm", "z_mm", "qx", "qy", "qz", "qw"});
  header.insert(header.end(), {"position_correction_mm", "rotation_correction_deg",
                               "residual_position_mm", "fault"});
  return header;
}

// A nanometre is far below any robot's resolution.
std::string Millimetres(double metres) { return absl::StrFormat("%.6f", metres * 1000); }

void AppendJoints(const v1::Nominal& nominal, const v1::CompensatedTarget& target,
                  std::vector<std::string>& cells) {
  for (int i = 0; i < nominal.joints_size(); ++i) {
    cells.push_back(i < target.joints_size() ? FormatNumber(target.joints(i)) : "");
  }
}

void AppendPose(const v1::CompensatedTarget& target, std::vector<std::string>& cells) {
  if (!target.has_pose()) {
    cells.resize(cells.size() + 7);
    return;
  }
  const v1::Pose& pose = target.pose();
  for (const double p : {pose.x_m(), pose.y_m(), pose.z_m()}) cells.push_back(Millimetres(p));
  for (const double q : {pose.qx(), pose.qy(), pose.qz(), pose.qw()})
    cells.push_back(FormatNumber(q));
}

void AppendCorrection(const v1::CompensatedTarget& target, std::vector<std::string>& cells) {
  if (!target.fault().empty()) {
    cells.insert(cells.end(), {"", "", "", target.fault()});
    return;
  }
  cells.push_back(absl::StrFormat("%.6f", target.position_correction_mm()));
  cells.push_back(absl::StrFormat("%.6f", target.rotation_correction_deg()));
  cells.push_back(absl::StrFormat("%.3g", target.residual_position_mm()));
  cells.push_back("");
}

}  // namespace

std::string WriteCompensatedTargets(const v1::Nominal& nominal,
                                    const v1::CompensateResponse& response) {
  const auto& targets = response.targets();
  const bool joints = std::any_of(targets.begin(), targets.end(),
                                  [](const auto& target) { return target.joints_size() > 0; });
  const bool pose = std::any_of(targets.begin(), targets.end(),
                                [](const auto& target) { return target.has_pose(); });
  std::string text = CsvLine(ResultHeader(nominal, joints, pose));
  for (const v1::CompensatedTarget& target : targets) {
    std::vector<std::string> cells = {StrCat(target.row())};
    if (joints) AppendJoints(nominal, target, cells);
    if (pose) AppendPose(target, cells);
    AppendCorrection(target, cells);
    text += CsvLine(cells);
  }
  return text;
}

}  // namespace truepose::formats
