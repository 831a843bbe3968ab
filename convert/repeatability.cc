#include "convert/repeatability.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "absl/strings/str_cat.h"
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

using Group = std::tuple<std::string, int, int>;  // of the column, placement and target

std::map<Group, std::vector<Visit>> VisitsOf(const std::vector<const v1::SessionInput*>& sessions,
                                             const ReadingsProblem& readings,
                                             const CalibrationResult& result) {
  const CalibrationProblem& whole = readings.problem;
  const Problem problem{&result.model, {}, whole.placements, whole.targets, whole.offsets};
  std::map<Group, std::vector<Visit>> visits;
  for (const Reading& reading : whole.readings) {
    const RowOf& row = readings.rows[reading.id];
    const std::string& group = sessions[row.session]->readings(row.row).group();
    if (group.empty() || PositionRowsOf(reading) != 3) continue;
    visits[{group, reading.placement, reading.target}].push_back(
        {reading.q, PointOf(problem, reading, result.before_frames)});
  }
  return visits;
}

// Takes the visits of one place out of `visits`: the last one and all that it connects.
std::vector<Visit> TakePlace(const Robot& robot, std::vector<Visit>* visits) {
  std::vector<Visit> place = {std::move(visits->back())};
  visits->pop_back();
  for (size_t i = 0; i < place.size(); ++i) {
    const Eigen::VectorXd q = place[i].q;
    const auto same = [&](const Visit& visit) { return SameJoints(robot, q, visit.q); };
    std::copy_if(visits->begin(), visits->end(), std::back_inserter(place), same);
    std::erase_if(*visits, same);
  }
  return place;
}

struct Places {
  std::vector<std::vector<Visit>> repeated;
  int left_out = 0, visits = 0;
};

Places PlacesOf(const Robot& robot, std::map<Group, std::vector<Visit>> visits) {
  Places places;
  for (auto& [group, list] : visits) {
    const bool alone = list.size() < 2;
    places.visits += static_cast<int>(list.size());
    while (!list.empty()) {
      std::vector<Visit> place = TakePlace(robot, &list);
      if (place.size() > 1) {
        places.repeated.push_back(std::move(place));
      } else if (!alone) {
        ++places.left_out;
      }
    }
  }
  return places;
}

void AddPairs(const std::vector<Visit>& visits,
              std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>* pairs) {
  for (size_t i = 0; i < visits.size(); ++i)
    for (size_t j = 0; j < i; ++j) pairs->emplace_back(visits[j].p, visits[i].p);
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
  const Places places = PlacesOf(*readings.problem.robot, VisitsOf(sessions, readings, result));
  if (places.left_out > 0)
    report->add_warnings(absl::StrCat("repeatability: ", places.left_out, " of ", places.visits,
                                      " readings left out: no other of their group has joints "
                                      "within 0.5 deg and 5 mm of theirs"));
  for (const std::vector<Visit>& visits : places.repeated) {
    AddPairs(visits, &pairs);
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
