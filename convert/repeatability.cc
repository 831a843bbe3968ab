#include "convert/repeatability.h"

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "convert/report.h"
#include "core/assessment/repeatability.h"
#include "core/identification/prediction.h"

namespace truepose::convert {
namespace {

constexpr double kSameAngle_rad = 0.00873;
constexpr double kSameLength_m = 0.005;

struct Visit {
  Eigen::VectorXd q;
  Eigen::Vector3d p;
};

bool SameJoints(const Robot& robot, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  for (int i = 0; i < robot.joint_count(); ++i) {
    const bool turns = robot.joints()[i].type == JointType::kRevolute;
    if (std::abs(a(i) - b(i)) > (turns ? kSameAngle_rad : kSameLength_m)) return false;
  }
  return true;
}

Eigen::Vector3d PointOf(const Problem& problem, const Reading& reading, const Estimate& before) {
  if (!reading.contact) return reading.X_MT.p;
  return (Inverse(before.X_MB[reading.placement]) * Predict(problem, reading, before)).p;
}

// Visits of each group, placement and target; those whose joints differ from the first's are left
// out.
std::vector<std::vector<Visit>> VisitsOf(const std::vector<const v1::SessionInput*>& sessions,
                                         const ReadingsProblem& readings,
                                         const CalibrationResult& result) {
  const CalibrationProblem& whole = readings.problem;
  const Problem problem{&result.model, {}, whole.placements, whole.targets, whole.offsets};
  std::map<std::tuple<std::string, int, int>, std::vector<Visit>> visits;
  for (const Reading& reading : whole.readings) {
    const RowOf& row = readings.rows[reading.id];
    const std::string& group = sessions[row.session]->readings(row.row).group();
    if (group.empty() || PositionRowsOf(reading) != 3) continue;
    std::vector<Visit>& known = visits[{group, reading.placement, reading.target}];
    if (known.empty() || SameJoints(*whole.robot, known[0].q, reading.q))
      known.push_back({reading.q, PointOf(problem, reading, result.before_frames)});
  }
  std::vector<std::vector<Visit>> repeated;
  for (auto& [key, list] : visits)
    if (list.size() > 1) repeated.push_back(std::move(list));
  return repeated;
}

Eigen::Matrix3Xd PointsOf(const std::vector<Visit>& visits) {
  Eigen::Matrix3Xd points(3, visits.size());
  for (size_t i = 0; i < visits.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = visits[i].p;
  return points;
}

}  // namespace

void FillRepeatability(const std::vector<const v1::SessionInput*>& sessions,
                       const ReadingsProblem& readings, const CalibrationResult& result,
                       v1::CalibrationReport* report) {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
  std::vector<Eigen::Matrix3Xd> groups;
  for (const std::vector<Visit>& visits : VisitsOf(sessions, readings, result)) {
    pairs.emplace_back(visits[0].p, visits[1].p);
    groups.push_back(PointsOf(visits));
  }
  if (groups.empty()) return;
  const PairRepeatability of_pairs = RepeatabilityOfPairs(pairs);
  const IsoRepeatability iso = RepeatabilityOfGroups(groups);
  v1::Repeatability* message = report->mutable_repeatability();
  message->set_pairs(static_cast<int>(pairs.size()));
  message->set_difference_mean_mm(of_pairs.difference_m.mean * kMmPerM);
  message->set_difference_sd_mm(of_pairs.difference_m.sd * kMmPerM);
  message->set_chapter_mm(of_pairs.mean_plus_3_sd_m * kMmPerM);
  message->set_groups(iso.groups);
  message->set_iso_rp_mm(iso.pooled_m * kMmPerM);
}

}  // namespace truepose::convert
